#include "scene/motion.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <vector>

namespace elastolab {
namespace {

using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180.0;
const Positions kRest = (Positions(3, 4) << 1, 2, 2, 1, 0, 0, 1, 1, 3, 3, 3, 4).finished();

/// Where a motion takes the vertices.
Positions moved(const Motion& motion) { return kRest + displacements(motion, kRest); }

Eigen::Matrix3d rotation(const Vector3d& degrees) {
    return Eigen::AngleAxisd(kDegree * degrees.norm(), degrees.normalized()).toRotationMatrix();
}

AffineMotion turned_by(const Motion& motion, const Vector3d& degrees, const Vector3d& center) {
    return std::get<AffineMotion>(turned(motion, kDegree * degrees, center, kRest));
}

/// Stretched, turned about a point that is not its middle, and moved.
const AffineMotion kAny{.matrix = (Eigen::Matrix3d() << 0.2, 0.1, 0, 0, -0.1, 0.3, 0, 0, 0.4).finished(),
                        .translate = {1, -2, 0.5},
                        .rotate = {.axis = {1, 2, -1}, .degrees = 250, .center = {3, 1, 0}}};

TEST(Motion, TurnsWhatTheMatrixLeftAboutTheCenterAndShiftsIt) {
    const Eigen::Matrix3d turn = rotation(250 * Vector3d(1, 2, -1).normalized());
    const Positions found = moved(kAny);
    for (Eigen::Index i = 0; i < kRest.cols(); ++i) {
        const Vector3d x = kRest.col(i), center = kAny.rotate.center;
        const Vector3d expected = center + turn * (x + kAny.matrix * x - center) + kAny.translate;
        EXPECT_LT((found.col(i) - expected).norm(), 1e-13);
    }
    EXPECT_LT((mean_displacement(kAny, kRest) - (found - kRest).rowwise().mean()).norm(), 1e-13);
}

TEST(Motion, FullTurnsLeaveEverythingWhereItWasExactly) {
    const AffineMotion twice{.rotate = {.axis = {1, 1, 1}, .degrees = -720, .center = {5, 6, 7}}};
    EXPECT_EQ(moved(twice), kRest);
}

TEST(Motion, TurnsAboutOneAxisAddUpWhereverTheirCenters) {
    AffineMotion motion{.matrix = kAny.matrix};
    Positions expected = moved(motion);
    for (int i = 0; i < 5; ++i) {
        const Vector3d center(i, 1, 2);
        const Eigen::Matrix3d turn = rotation({0, 0, 170});
        expected = ((turn * (expected.colwise() - center)).colwise() + center).eval();
        motion = turned_by(motion, {0, 0, 170}, center);
    }
    EXPECT_NEAR(motion.rotate.degrees, 850, 1e-9);
    EXPECT_EQ(motion.rotate.axis, Vector3d::UnitZ());
    EXPECT_LT((moved(motion) - expected).norm(), 1e-12);
    EXPECT_NEAR(turned_by(motion, {0, 0, -840}, {0, 0, 0}).rotate.degrees, 10, 1e-9);
}

/// A scene file takes a hundred turns.
TEST(Motion, TurnsAddUpToWhatAFileTakes) {
    for (const double sign : {1.0, -1.0}) {
        AffineMotion motion = kAny;
        motion.rotate = {};
        for (int i = 0; i < 450; ++i) motion = turned_by(motion, {0, 0, sign * 90.0}, {1, 2, 3});
        EXPECT_LE(std::abs(motion.rotate.degrees), kMostDegrees);
        EXPECT_GT(std::abs(motion.rotate.degrees), kMostDegrees - 360.0);
        AffineMotion half = kAny;
        half.rotate = {};
        for (int i = 0; i < 2; ++i) half = turned_by(half, {0, 0, 90.0}, {1, 2, 3});
        EXPECT_LT((moved(motion) - moved(half)).norm(), 1e-9);
    }
}

TEST(Motion, BackToNoTurnAtAllIsNoTurn) {
    const AffineMotion there = turned_by(AffineMotion{.translate = {1, 0, 0}}, {0, 50, 0}, {1, 2, 3});
    EXPECT_EQ(turned_by(there, {0, -50, 0}, {1, 2, 3}).rotate, Rotation{});
}

TEST(Motion, ATurnAboutTheMiddleMovesItAlongAStraightLine) {
    const Vector3d middle = kRest.rowwise().mean();
    const Motion motion = turned_by(translated(AffineMotion{}, {2, 0, 0}), {0, 400, 0}, middle + Vector3d(2, 0, 0));
    for (const double part : {0.25, 0.5, 1.0})
        EXPECT_LT((mean_displacement(part_of(motion, part, kRest), kRest) - part * Vector3d(2, 0, 0)).norm(), 1e-12);
}

/// Where each vertex ends is right whatever axes follow each other, and the angle is remembered where it can be.
TEST(Motion, TurnsAboutOtherAxesKeepTheFullTurnsBefore) {
    for (const double before : {30.0, 170.0, 350.0, 360.0, 720.0})
        for (const Vector3d& next : {Vector3d(20, 0, 0), Vector3d(0, 60, 0), Vector3d(5, 0, 5)}) {
            const AffineMotion first = turned_by(kAny, before * kAny.rotate.axis.normalized(), {0, 1, 0});
            const Vector3d center(1, 0, -1);
            const AffineMotion second = turned_by(first, next, center);
            const Positions expected = ((rotation(next) * (moved(first).colwise() - center)).colwise() + center).eval();
            EXPECT_LT((moved(second) - expected).norm(), 1e-11);
            EXPECT_LT(std::abs(second.rotate.degrees - first.rotate.degrees), 180.0) << before << "; " << next;
        }
}

TEST(Motion, ALinearMapFollowsTheTurn) {
    const Eigen::Matrix3d map = (Eigen::Matrix3d() << 1, 0.2, 0, 0, 2, 0, 0.1, 0, 0.5).finished();
    const Vector3d center(0, 2, 1);
    const Motion found = transformed(kAny, map, center, kRest);
    EXPECT_LT((moved(found) - ((map * (moved(kAny).colwise() - center)).colwise() + center)).norm(), 1e-12);
    EXPECT_EQ(std::get<AffineMotion>(found).rotate, kAny.rotate);
}

TEST(Motion, PartsLeadFromRestToTheWholeThroughEveryAngle) {
    EXPECT_LT((moved(part_of(kAny, 0.0, kRest)) - kRest).norm(), 1e-13);
    EXPECT_LT((moved(part_of(kAny, 1.0, kRest)) - moved(kAny)).norm(), 1e-13);
    const Vector3d center(1, 1, 0);
    const AffineMotion hinge{.rotate = {.axis = {0, 0, 1}, .degrees = 720, .center = center}};
    for (const double part : {0.125, 0.25, 0.6}) {
        const Positions expected =
            ((rotation({0, 0, 720 * part}) * (kRest.colwise() - center)).colwise() + center).eval();
        EXPECT_LT((moved(part_of(hinge, part, kRest)) - expected).norm(), 1e-12) << part;
    }
}

/// Scene files of before know a turn as a matrix only: half of a turn by 90 degrees is one by 45, not a squeezed body.
TEST(Motion, PartsOfARotationInTheMatrixAreTurns) {
    const AffineMotion matrix{.matrix = rotation({90, 0, 0}) - Eigen::Matrix3d::Identity(), .translate = {0, 1, 0}};
    const Vector3d middle = kRest.rowwise().mean(), shift = mean_displacement(matrix, kRest);
    const Positions expected =
        ((rotation({45, 0, 0}) * (kRest.colwise() - middle)).colwise() + (middle + 0.5 * shift)).eval();
    EXPECT_LT((moved(part_of(matrix, 0.5, kRest)) - expected).norm(), 1e-12);
    const VertexMotion single{{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {1, 1, 1}}};
    EXPECT_EQ(displacements(part_of(single, 0.5, kRest), kRest), 0.5 * displacements(single, kRest));
}

TEST(MotionTo, IsAffineWhereThePlacesAre) {
    const Motion found = motion_to(kRest, moved(kAny));
    ASSERT_TRUE(std::holds_alternative<AffineMotion>(found));
    EXPECT_LT((moved(found) - moved(kAny)).norm(), 1e-12);
}

TEST(MotionTo, IsAPlacementWhereThePatchIsTurnedAndMoved) {
    Placement placement;
    placement.move = {0.5, -1.0, 2.0};
    placement.turn = {0.0, 40.0, 0.0};
    for (const bool flat : {false, true}) {
        Positions rest = kRest;
        if (flat) rest.row(2).setConstant(0.7);
        const Motion wanted = motion_of(placement, rest);
        const std::optional<Placement> found = placement_of(motion_to(rest, rest + displacements(wanted, rest)), rest);
        ASSERT_TRUE(found) << flat;
        EXPECT_LT((found->move - placement.move).norm(), 1e-12);
        EXPECT_LT((found->turn - placement.turn).norm(), 1e-9);
        EXPECT_NEAR(found->scale, 1.0, 1e-12);
    }
}

TEST(MotionTo, IsOfSingleVerticesWhereThePatchIsBent) {
    Positions bent = kRest;
    bent(2, 0) += 1.0, bent(2, 1) -= 1.0, bent(2, 2) += 1.0, bent(2, 3) -= 1.0;
    EXPECT_LT((moved(motion_to(kRest, bent)) - bent).norm(), 1e-12);
    const Positions line = (Positions(3, 3) << 0, 1, 3, 0, 0, 0, 0, 0, 0).finished(),
                    turned_line = (Positions(3, 3) << 0, 0, 0, 0, 1, 3, 5, 5, 5).finished();
    const Motion of_line = motion_to(line, turned_line);
    EXPECT_LT((line + displacements(of_line, line) - turned_line).norm(), 1e-12);
    const Positions one = line.rightCols(1), moved_one = turned_line.rightCols(1);
    EXPECT_EQ(std::get<AffineMotion>(motion_to(one, moved_one)).translate, Vector3d(moved_one - one));
}

TEST(Placement, MovesTheMiddleAndTurnsAboutIt) {
    const Vector3d middle = kRest.rowwise().mean();
    const Placement placement{.move = {1, 2, 3}, .turn = {0, 0, 90}, .scale = 2.0};
    const Positions found = moved(motion_of(placement, kRest));
    for (Eigen::Index i = 0; i < kRest.cols(); ++i) {
        const Vector3d from = kRest.col(i) - middle;
        const Vector3d expected = middle + placement.move + 2.0 * Vector3d(-from.y(), from.x(), from.z());
        EXPECT_LT((found.col(i) - expected).norm(), 1e-12);
    }
}

TEST(Placement, IsFoundAgain) {
    for (const Vector3d& turn : {Vector3d(0, 0, 0), Vector3d(30, -40, 120), Vector3d(-170, 80, 5), Vector3d(0, 0, 180),
                                 Vector3d(0, 0, -720), Vector3d(400, 20, 0)}) {
        const Placement placement{.move = {0.1, -5, 2}, .turn = turn, .scale = 0.4};
        const auto found = placement_of(motion_of(placement, kRest), kRest);
        ASSERT_TRUE(found);
        EXPECT_LT((found->move - placement.move).norm(), 1e-12);
        EXPECT_LT((found->turn - turn).norm(), 1e-9) << found->turn.transpose();
        EXPECT_NEAR(found->scale, 0.4, 1e-12);
    }
}

TEST(Placement, KnowsATurnThatIsWrittenAsAMatrix) {
    const auto found =
        placement_of(AffineMotion{.matrix = 1.5 * rotation({30, 0, 40}) - Eigen::Matrix3d::Identity()}, kRest);
    ASSERT_TRUE(found);
    EXPECT_LT((found->turn - Vector3d(30, 0, 40)).norm(), 1e-9);
    EXPECT_NEAR(found->scale, 1.5, 1e-12);
}

TEST(Placement, IsNoneOfShearMirrorsTwoTurnsAndSingleVertices) {
    Eigen::Matrix3d shear = Eigen::Matrix3d::Zero();
    shear(0, 1) = 0.1;
    EXPECT_FALSE(placement_of(AffineMotion{.matrix = shear}, kRest));
    EXPECT_FALSE(placement_of(AffineMotion{.matrix = -2.0 * Eigen::Matrix3d::Identity()}, kRest));
    EXPECT_FALSE(placement_of(AffineMotion{.matrix = rotation({9, 0, 0}) - Eigen::Matrix3d::Identity(),
                                           .rotate = {.axis = {0, 1, 0}, .degrees = 400}},
                              kRest));
    EXPECT_FALSE(placement_of(VertexMotion{std::vector<Vector3d>(4, {1, 0, 0})}, kRest));
}

}  // namespace
}  // namespace elastolab
