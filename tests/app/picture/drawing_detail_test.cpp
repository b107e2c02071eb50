#include "app/picture/drawing_detail.hpp"

#include <gtest/gtest.h>

namespace elastolab {
namespace {

constexpr double kStep = 0.1;

/// A picture takes this long, times what its detail leaves.
struct Screen {
    double full_seconds = 0.0;
    double triangles = 1.0;  ///< the part of them that is left where not all are drawn
    double now = 0.0;
    DetailKeeper keeper = {};

    double cost(const DrawingDetail& detail) const {
        return full_seconds * (detail.soft_shadows ? 1.0 : 0.6) * (detail.samples == 1 ? 0.5 : 1.0) *
               (detail.wireframe ? 1.0 : 0.5) * (detail.all_triangles ? 1.0 : triangles) * detail.resolution;
    }
    DrawingDetail frame(bool moved, bool may_try = true) {
        now += kStep;
        const DrawingDetail detail = keeper.choose(moved, now, may_try);
        keeper.took(cost(detail));
        now += cost(detail);
        return detail;
    }
};

TEST(DetailKeeper, LeavesNothingOutWhereDrawingIsQuick) {
    Screen screen{.full_seconds = 0.02};
    EXPECT_FALSE(screen.frame(true).soft_shadows) << "nobody knows yet";
    for (int i = 0; i < 20; ++i) EXPECT_EQ(screen.frame(true), DrawingDetail{});
    EXPECT_LT(screen.keeper.due_in(screen.now), 0.0);
}

TEST(DetailKeeper, LeavesOutAsMuchAsItMustWhileSomethingMovesAndNothingAtRest) {
    for (const double seconds : {0.07, 0.3, 0.9}) {
        Screen screen{.full_seconds = seconds};
        screen.frame(true);
        DrawingDetail moving;
        for (int i = 0; i < 8; ++i) moving = screen.frame(true);
        EXPECT_FALSE(moving.soft_shadows);
        EXPECT_LE(screen.cost(moving), DetailKeeper::kSlowSeconds) << seconds;
        EXPECT_GT(screen.keeper.due_in(screen.now), 0.0);
        screen.now += DetailKeeper::kRestSeconds;
        EXPECT_EQ(screen.keeper.due_in(screen.now), 0.0);
        EXPECT_EQ(screen.frame(false), DrawingDetail{});
        EXPECT_LT(screen.keeper.due_in(screen.now), 0.0);
        // The next motion begins as the last one ended.
        EXPECT_EQ(screen.frame(true), moving);
    }
}

/// Shaders of software OpenGL take a third of a second of the cores that compute the answer which is waited for.
TEST(DetailKeeper, TriesNothingNewWhileSomethingElseIsComputed) {
    Screen screen{.full_seconds = 0.02};
    for (int i = 0; i < 5; ++i) EXPECT_FALSE(screen.frame(true, false).soft_shadows);
    EXPECT_EQ(screen.frame(true, true), DrawingDetail{});
    EXPECT_EQ(screen.frame(true, false), DrawingDetail{}) << "its cost is known";
}

/// Whoever waits a second for a picture does not wait for six of them until it is quick.
TEST(DetailKeeper, OfAVeryLargeBodyLeavesOutTrianglesAtOnce) {
    Screen screen{.full_seconds = 2.0, .triangles = 0.1};
    for (int i = 0; i < 2; ++i) screen.frame(true);  // the first one compiles shaders
    EXPECT_FALSE(screen.frame(true).all_triangles);
    EXPECT_EQ(screen.frame(true).resolution, 1.0);
}

/// A pause that is shorter than rest changes nothing: pictures do not flicker.
TEST(DetailKeeper, KeepsTheDetailThroughShortPauses) {
    Screen screen{.full_seconds = 0.3};
    DrawingDetail moving;
    for (int i = 0; i < 8; ++i) moving = screen.frame(true);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(screen.frame(false), moving);
    EXPECT_EQ(screen.frame(true), moving);
}

TEST(DetailKeeper, LearnsAnewForAnotherBody) {
    Screen screen{.full_seconds = 0.9};
    for (int i = 0; i < 8; ++i) screen.frame(true);
    screen.keeper.forget();
    screen.full_seconds = 0.01;
    screen.frame(true);
    for (int i = 0; i < 8; ++i) EXPECT_EQ(screen.frame(true), DrawingDetail{});
}

/// The window shows something soon, and a press is not kept waiting by a picture with all detail.
TEST(DetailKeeper, BeginsWithLittleAndGoesOnAtRest) {
    Screen screen{.full_seconds = 0.3};
    EXPECT_EQ(screen.frame(false).samples, 1);
    EXPECT_FALSE(screen.frame(false).soft_shadows);
    EXPECT_GT(screen.keeper.due_in(screen.now), 0.0);
    screen.now += DetailKeeper::kRestSeconds;
    EXPECT_EQ(screen.frame(false), DrawingDetail{});
}

}  // namespace
}  // namespace elastolab
