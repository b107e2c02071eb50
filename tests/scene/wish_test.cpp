#include "scene/wish.hpp"

#include <gtest/gtest.h>

namespace elastolab {
namespace {

/// The corners of the right face of a unit cube, turned about its middle.
const Positions kFace = (Positions(3, 4) << 1, 1, 1, 1, 0, 1, 0, 1, 0, 0, 1, 1).finished();

Wish turned(double degrees, const Eigen::Vector3d& axis = Eigen::Vector3d::UnitX()) {
    const AffineMotion motion{.rotate = {.axis = axis, .degrees = degrees, .center = {1, 0.5, 0.5}}};
    return {.values = displacements(motion, kFace).reshaped(), .motions = {motion}, .ends = {4}};
}

TEST(Wish, IsTheSameAfterTheSameFullTurnsOnly) {
    EXPECT_TRUE(same(turned(30), turned(30)));
    EXPECT_FALSE(same(turned(30), turned(31)));
    EXPECT_EQ(turned(0).values, turned(720).values);
    EXPECT_FALSE(same(turned(0), turned(720)));
}

TEST(Wish, AWayPassesEveryQuarterOfFullTurns) {
    EXPECT_EQ(way_to(turned(140), nullptr, kFace).path.cols(), 0) << "the shortest rotation is meant";
    const Way way = way_to(turned(720), nullptr, kFace);
    EXPECT_TRUE(way.from_rest);
    ASSERT_EQ(way.path.cols(), 7);
    for (int i = 0; i < 7; ++i) EXPECT_LT((way.path.col(i) - turned(90 * (i + 1)).values).norm(), 1e-12) << i;
}

TEST(Wish, AWayBetweenTwoTurnsIsTheDifference) {
    const Wish twice = turned(720), once = turned(-360, -Eigen::Vector3d::UnitX());
    EXPECT_EQ(way_to(turned(700), &twice, kFace).path.cols(), 0);
    const Way back = way_to(turned(0), &twice, kFace);
    EXPECT_FALSE(back.from_rest);
    ASSERT_EQ(back.path.cols(), 7);
    EXPECT_LT((back.path.col(0) - turned(630).values).norm(), 1e-12);
    const Way on = way_to(twice, &once, kFace);
    EXPECT_FALSE(on.from_rest);
    ASSERT_EQ(on.path.cols(), 3);
    EXPECT_LT((on.path.col(2) - turned(630).values).norm(), 1e-12);
    const Way aside = way_to(turned(300, {0, 1, 0}), &twice, kFace);
    EXPECT_TRUE(aside.from_rest) << "about another axis there is no telling what lies between";
    EXPECT_EQ(aside.path.cols(), 3);
}

TEST(Wish, AStepTurnsByAboutAsMuchAsIsAllowed) {
    const std::optional<Wish> step = step_towards(turned(130), turned(10), 30, kFace);
    ASSERT_TRUE(step.has_value());
    EXPECT_LT((step->values - turned(40).values).norm(), 1e-12);
    EXPECT_NEAR(turn_between(step->motions[0], turned(40).motions[0]), 0.0, 1e-9);
    EXPECT_FALSE(step_towards(turned(40), turned(0), 30, kFace).has_value()) << "no short step is left over";
    EXPECT_FALSE(step_towards(turned(100), turned(100, {0, 1, 0}), 30, kFace).has_value()) << "what lies between?";
    const std::optional<Wish> wound = step_towards(turned(720), turned(0), 30, kFace);
    ASSERT_TRUE(wound.has_value());
    EXPECT_NEAR(turn_between(wound->motions[0], turned(0).motions[0]), 30.0, 1e-9);
}

TEST(Wish, AStepMovesTheOtherHandlesAsFarAlong) {
    Wish from = turned(0), to = turned(90);
    for (Wish* wish : {&from, &to}) {
        const Eigen::Vector3d shift = wish == &to ? Eigen::Vector3d(3, 6, 9) : Eigen::Vector3d(0, 0, 0);
        wish->values.conservativeResize(15);
        wish->values.tail<3>() = shift;
        wish->motions.emplace_back(VertexMotion{{shift}});
        wish->ends.push_back(5);
    }
    Positions rest(3, 5);
    rest << kFace, Eigen::Vector3d(0, 0, 0);
    const std::optional<Wish> step = step_towards(to, from, 30, rest);
    ASSERT_TRUE(step.has_value());
    EXPECT_LT((step->values.tail<3>() - Eigen::Vector3d(1, 2, 3)).norm(), 1e-12);
}

TEST(Wish, AWayMovesTheOtherHandlesAlong) {
    Wish two = turned(360);
    two.values.conservativeResize(15);
    two.values.tail<3>() << 1, 2, 3;
    two.motions.emplace_back(VertexMotion{{{1, 2, 3}}});
    two.ends.push_back(5);
    Positions rest(3, 5);
    rest << kFace, Eigen::Vector3d(0, 0, 0);
    const Way way = way_to(two, nullptr, rest);
    ASSERT_EQ(way.path.cols(), 3);
    EXPECT_LT((way.path.col(1).tail<3>() - Eigen::Vector3d(0.5, 1, 1.5)).norm(), 1e-14);
}

}  // namespace
}  // namespace elastolab
