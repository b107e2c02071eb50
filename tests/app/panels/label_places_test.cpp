#include "app/panels/label_places.hpp"

#include <gtest/gtest.h>

namespace elastolab {
namespace {

using Eigen::Vector2d;
using Box = LabelPlaces::Box;

constexpr double kGap = 18.0;

const Viewport kColumn{.x = 100.0, .y = 50.0, .width = 300.0, .height = 200.0};

TEST(LabelPlaces, StandToTheRightOfTheirPointsWhereThatIsFree) {
    LabelPlaces labels(kColumn, 5.0);
    const Box box = labels.take({150.0, 150.0}, {80.0, 14.0}, kGap);
    EXPECT_EQ(box.min(), Vector2d(168.0, 143.0));
    EXPECT_EQ(box.sizes(), Vector2d(80.0, 14.0));
    EXPECT_LT(labels.take({380.0, 150.0}, {80.0, 14.0}, kGap).max().x(), 380.0) << "to the left at the right edge";
}

TEST(LabelPlaces, StayInsideAndApartAsLongAsThereIsRoom) {
    for (const double width : {60.0, 150.0, 285.0}) {
        LabelPlaces labels(kColumn, 5.0);
        const Box title(Vector2d(105.0, 55.0), Vector2d(300.0, 90.0));
        labels.cover(title);
        std::vector<Box> taken = {title};
        // Points close to one another, in the corners, at the edges.
        for (const Vector2d& point : {Vector2d(250, 150), Vector2d(255, 152), Vector2d(245, 149), Vector2d(101, 51),
                                      Vector2d(399, 249), Vector2d(399, 150)}) {
            const Box box = labels.take(point, {width, 14.0}, kGap);
            EXPECT_TRUE(Box(Vector2d(105, 55), Vector2d(395, 245)).contains(box)) << box.min().transpose();
            for (const Box& other : taken) EXPECT_FALSE(box.intersects(other)) << point.transpose();
            taken.push_back(box);
        }
    }
}

TEST(LabelPlaces, KeepOffWhatStandsOverTheViewport) {
    Viewport column = kColumn;
    column.covered = 100.0;
    LabelPlaces labels(column, 5.0);
    EXPECT_EQ(labels.width(), 190.0);
    EXPECT_LE(labels.take({290.0, 150.0}, {150.0, 14.0}, kGap).max().x(), 295.0);
}

/// More than there is room for: none is lost, and the beginning of one that is too wide is seen.
TEST(LabelPlaces, AreKeptWhereTheyDoNotFit) {
    LabelPlaces labels({.x = 0.0, .y = 0.0, .width = 60.0, .height = 30.0}, 5.0);
    for (int i = 0; i < 20; ++i) {
        const Box box = labels.take({30.0, 15.0}, {200.0, 14.0}, kGap);
        EXPECT_EQ(box.min().x(), 5.0);
        EXPECT_GE(box.min().y(), 5.0);
        EXPECT_EQ(box.sizes(), Vector2d(200.0, 14.0));
    }
    LabelPlaces none({.x = 0.0, .y = 0.0, .width = 1.0, .height = 1.0}, 5.0);
    EXPECT_EQ(none.width(), 0.0);
    EXPECT_TRUE(none.take({0.5, 0.5}, {20.0, 14.0}, kGap).min().allFinite());
}

}  // namespace
}  // namespace elastolab
