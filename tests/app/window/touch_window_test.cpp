// Fingers on a touch screen, in the real program on an X server that has one.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "app/real_window.hpp"
#include "app/screen.hpp"
#include "app/stage.hpp"
#include "app/touch_display.hpp"
#include "app/window/touch_screen.hpp"
#include "scene/file/scene_file.hpp"

namespace elastolab::test {
namespace {

using Eigen::Vector2d;

/// The cube in a window on a touch screen.
class Touched : public testing::Test {
protected:
    void SetUp() override {
        if (!TouchScreen::supported()) GTEST_SKIP() << "built without XInput";
        if (!display_.missing().empty()) GTEST_SKIP() << display_.missing();
        save_scene(folder_.path() / "cube.json", cube_document(4));
        screen_.emplace(folder_.path() / "cube.json");
        window_.emplace(std::vector<std::string>{"cube.json", "--size", "1000x700", "--scene-out", "out.json"},
                        folder_.path());
        window_->settle();
    }
    /// Fingers that come down together, go along these ways in ten steps and are lifted.
    void slide(const std::vector<std::pair<Vector2d, Vector2d>>& ways) {
        const auto at = [&](std::size_t i, double t) {
            return Vector2d(ways[i].first + t * (ways[i].second - ways[i].first));
        };
        for (std::size_t i = 0; i < ways.size(); ++i) display_.begin(static_cast<int>(i), at(i, 0.0));
        for (int step = 1; step <= 10; ++step)
            for (std::size_t i = 0; i < ways.size(); ++i) display_.move(static_cast<int>(i), at(i, 0.1 * step));
        for (std::size_t i = 0; i < ways.size(); ++i) display_.end(static_cast<int>(i), at(i, 1.0));
        window_->settle();
    }
    Document left() {
        EXPECT_EQ(window_->quit().exit_code, 0);
        return load_scene(folder_.path() / "out.json");
    }
    /// Where the only handle was moved to by then.
    static Eigen::Vector3d moved(const Document& document, const Eigen::Vector3d& at) {
        EXPECT_EQ(document.handles.size(), 1u);
        return map_of(std::get<AffineMotion>(document.handles.at(0).motion)).displacement(at);
    }

    TouchDisplay display_;
    TemporaryFolder folder_;
    std::optional<Screen> screen_;
    std::optional<RealWindow> window_;
    const Eigen::Vector3d corner_{1, 0.5, 0.5};  ///< a vertex that is pulled
    const Vector2d shift_{60, -50};              ///< pixels
};

TEST_F(Touched, OneFingerPullsThePatchBelowIt) {
    const Vector2d from = screen_->pixel(corner_);
    slide({{from, from + shift_}});
    const Eigen::Vector3d u = moved(left(), corner_);
    EXPECT_LT((screen_->pixel(corner_ + u) - from - shift_).norm(), 2.0) << "once, not by an emulated mouse as well";
}

TEST_F(Touched, TwoFingersZoomToWhereTheyAreAndPullNothing) {
    const Vector2d at = screen_->pixel(corner_), apart(40, 0);
    slide({{at - apart, at - 2.0 * apart}, {at + apart, at + 2.0 * apart}});
    slide({{at, at + shift_}});
    const Eigen::Vector3d u = moved(left(), corner_);
    const Vector2d unzoomed = screen_->pixel(corner_ + u) - at;
    EXPECT_LT((2.0 * unzoomed - shift_).norm(), 0.06 * shift_.norm()) << unzoomed.transpose();
}

TEST_F(Touched, APinchOnTheTrackpadZoomsToTheCursor) {
    const Vector2d at = screen_->pixel(corner_);
    window_->move(at);
    display_.pinch(2.0);
    window_->settle();
    window_->drag(at, at + shift_);
    window_->settle();
    const Eigen::Vector3d u = moved(left(), corner_);
    EXPECT_LT((2.0 * (screen_->pixel(corner_ + u) - at) - shift_).norm(), 0.06 * shift_.norm());
}

TEST_F(Touched, TwoFingersMoveTheView) {
    const Vector2d at = screen_->pixel(corner_), apart(40, 0), way(-80, 60);
    slide({{at - apart, at - apart + way}, {at + apart, at + apart + way}});
    slide({{at + way, at + way + shift_}});
    const Eigen::Vector3d u = moved(left(), corner_);
    EXPECT_LT((screen_->pixel(corner_ + u) - at - shift_).norm(), 0.1 * shift_.norm());
}

TEST_F(Touched, ThreeFingersTurnTheView) {
    const Vector2d at = screen_->pixel(corner_), way(0, 300);
    slide({{at, at + way},
           {at + Vector2d(60, 0), at + Vector2d(60, 0) + way},
           {at + Vector2d(0, 60), at + Vector2d(0, 60) + way}});
    slide({{at, at + Vector2d(0, -80)}});
    // Seen from above, up the screen is along the ground.
    const Eigen::Vector3d u = moved(left(), corner_);
    EXPECT_LT(std::abs(u.z()), 0.2 * u.norm());
}

TEST_F(Touched, ATapIsAClickInTheMenuAndOnTheBody) {
    const auto tap = [&](const Vector2d& at) {
        display_.begin(0, at);
        display_.end(0, at);
        window_->settle();
    };
    tap({62, 12});   // Edit
    tap({97, 130});  // New fixed set
    tap(screen_->pixel(corner_));
    const Document document = left();
    EXPECT_TRUE(document.handles.empty());
    ASSERT_EQ(document.fixed.size(), 2u);
    const std::vector<int>& painted = std::get<VertexSelector>(document.fixed[1].select.shape).vertices;
    ASSERT_EQ(painted.size(), 1u) << "a click with the brush takes one vertex";
    EXPECT_EQ(screen_->mesh().vertices.col(painted[0]), corner_);
}

}  // namespace
}  // namespace elastolab::test
