#include "scene/motion.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace elastolab {
namespace {

const Positions kRest = (Positions(3, 4) << 1, 2, 2, 1, 0, 0, 1, 1, 3, 3, 3, 4).finished();

/// Where a motion takes the vertices.
Positions moved(const AffineMotion& motion) {
    return kRest + ((motion.matrix * kRest).colwise() + motion.translate).eval();
}

TEST(Placement, MovesTheMiddleAndTurnsAboutIt) {
    const Eigen::Vector3d middle = kRest.rowwise().mean();
    const Placement placement{.move = {1, 2, 3}, .turn = {0, 0, 90}, .scale = 2.0};
    const Positions found = moved(motion_of(placement, kRest));
    for (Eigen::Index i = 0; i < kRest.cols(); ++i) {
        const Eigen::Vector3d from = kRest.col(i) - middle;
        const Eigen::Vector3d expected = middle + placement.move + 2.0 * Eigen::Vector3d(-from.y(), from.x(), from.z());
        EXPECT_LT((found.col(i) - expected).norm(), 1e-12);
    }
}

/// x first, then y, then z, all about axes of the world: a quarter about x takes y to z, one about z leaves it there.
TEST(Placement, TurnsAboutXThenYThenZ) {
    const AffineMotion motion = motion_of({.turn = {90, 0, 90}}, kRest);
    const Eigen::Matrix3d turn = Eigen::Matrix3d::Identity() + motion.matrix;
    EXPECT_LT((turn * Eigen::Vector3d::UnitY() - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
    EXPECT_LT((turn * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 1e-12);
}

TEST(Placement, IsFoundAgain) {
    for (const Eigen::Vector3d& turn : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(30, -40, 120),
                                        Eigen::Vector3d(-170, 80, 5), Eigen::Vector3d(0, 0, 180)}) {
        const Placement placement{.move = {0.1, -5, 2}, .turn = turn, .scale = 0.4};
        const auto found = placement_of(motion_of(placement, kRest), kRest);
        ASSERT_TRUE(found);
        EXPECT_LT((found->move - placement.move).norm(), 1e-12);
        EXPECT_LT((found->turn - turn).norm(), 1e-9) << found->turn.transpose();
        EXPECT_NEAR(found->scale, 0.4, 1e-12);
    }
}

/// Turned by a quarter about y there is no one choice of the other two; any that gives the same motion will do.
TEST(Placement, WhereAnglesAreNotUniqueGivesTheSameMotion) {
    const AffineMotion motion = motion_of({.turn = {20, 90, 50}}, kRest);
    const auto found = placement_of(motion, kRest);
    ASSERT_TRUE(found);
    EXPECT_LT((motion_of(*found, kRest).matrix - motion.matrix).norm(), 1e-6);
}

TEST(Placement, IsNoneOfShearMirrorsAndSingleVertices) {
    Eigen::Matrix3d shear = Eigen::Matrix3d::Zero();
    shear(0, 1) = 0.1;
    EXPECT_FALSE(placement_of(AffineMotion{.matrix = shear}, kRest));
    EXPECT_FALSE(placement_of(AffineMotion{.matrix = -2.0 * Eigen::Matrix3d::Identity()}, kRest));
    EXPECT_FALSE(placement_of(VertexMotion{std::vector<Eigen::Vector3d>(4, {1, 0, 0})}, kRest));
}

}  // namespace
}  // namespace elastolab
