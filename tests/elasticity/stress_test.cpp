#include "elasticity/stress.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Geometry>
#include <limits>

namespace elastolab {
namespace {

const Eigen::Matrix3d kTurn = (Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized())).toRotationMatrix();

TEST(Stress, IsSixNumbersAndBack) {
    StressNumbers s;
    s << 1, 2, 3, 4, 5, 6;
    const Eigen::Matrix3d tensor = stress_tensor(s);
    EXPECT_EQ(tensor(0, 1), 4);
    EXPECT_EQ(tensor(1, 2), 5);
    EXPECT_EQ(tensor(0, 2), 6);
    EXPECT_EQ(tensor, tensor.transpose());
    EXPECT_EQ(stress_numbers(tensor), s);
}

TEST(Stress, ByHookesLawOfAStretchedBar) {
    const Material material{2e5, 0.3};
    const Eigen::Vector3d stretch(0.01, -0.003, -0.003);
    EXPECT_LT((hooke(stretch.asDiagonal(), material) - 2000.0 * StressNumbers::Unit(0)).norm(), 1e-9);
    Eigen::Matrix3d spin = Eigen::Matrix3d::Zero();
    spin(0, 1) = 1.0, spin(1, 0) = -1.0;
    EXPECT_EQ(hooke(spin, material).norm(), 0.0);
    EXPECT_TRUE(hooke(stretch.asDiagonal(), {1.0, 0.5}).allFinite());
}

TEST(Stress, IsMeasuredHoweverLargeOrSmallItIs) {
    const Eigen::Matrix3d stress = Eigen::Vector3d(-4.0, 3.0, 1.0).asDiagonal();
    for (const StressMeasure which :
         {StressMeasure::von_mises, StressMeasure::first_principal, StressMeasure::third_principal})
        for (const double size : {1e-200, 1e160, 1e300})
            EXPECT_NEAR(measure(which, size * stress) / size, measure(which, stress), 1e-14) << size;
    EXPECT_EQ(measure(StressMeasure::von_mises, Eigen::Matrix3d::Zero()), 0.0);
    Eigen::Matrix3d broken = Eigen::Matrix3d::Zero();
    broken(2, 1) = broken(1, 2) = std::nan("");
    EXPECT_TRUE(std::isnan(measure(StressMeasure::von_mises, broken)));
}

TEST(Stress, HasMeasuresThatTurnsLeaveAlone) {
    const Eigen::Matrix3d turned = kTurn * Eigen::Vector3d(-4.0, 3.0, 1.0).asDiagonal() * kTurn.transpose();
    EXPECT_NEAR(measure(StressMeasure::first_principal, turned), 3.0, 1e-14);
    EXPECT_NEAR(measure(StressMeasure::third_principal, turned), -4.0, 1e-14);
    EXPECT_NEAR(measure(StressMeasure::von_mises, turned), std::sqrt(0.5 * (49.0 + 4.0 + 25.0)), 1e-14);
    EXPECT_NEAR(measure(StressMeasure::von_mises, Eigen::Matrix3d::Identity()), 0.0, 1e-14);  // pressure
    EXPECT_EQ(measure(StressMeasure::yz, turned), turned(1, 2));
    EXPECT_EQ(measure(StressMeasure::xx, turned), turned(0, 0));
}

TEST(Stress, WithEqualPrincipalValuesKeepsTheirDigits) {
    const Eigen::Matrix3d almost =
        Eigen::Matrix3d::Identity() + 1e-10 * kTurn * Eigen::Vector3d(1, -1, 0).asDiagonal() * kTurn.transpose();
    EXPECT_NEAR(measure(StressMeasure::first_principal, almost) - 1.0, 1e-10, 1e-14);
}

}  // namespace
}  // namespace elastolab
