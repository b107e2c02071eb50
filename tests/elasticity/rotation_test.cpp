#include "elasticity/rotation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

namespace elastolab {
namespace {

using Eigen::Vector3d;

constexpr double kToRadians = std::numbers::pi / 180.0;

TEST(Rotation, IsAboutItsVectorByItsLength) {
    const Eigen::Matrix3d quarter = rotation_by(90.0 * kToRadians * Vector3d::UnitZ());
    EXPECT_LT((quarter * Vector3d(1, 2, 3) - Vector3d(-2, 1, 3)).norm(), 1e-15);
    EXPECT_EQ(rotation_by(Vector3d::Zero()), Eigen::Matrix3d::Identity());
    const Vector3d small(1e-9, -2e-9, 3e-9);
    EXPECT_LT((rotation_by(small) - Eigen::Matrix3d::Identity() - cross_matrix(small)).norm(), 1e-16);
    EXPECT_LT((cross_matrix({1, 2, 3}) * Vector3d(4, 5, 7) - Vector3d(1, 2, 3).cross(Vector3d(4, 5, 7))).norm(), 1e-15);
}

TEST(Rotation, ItsVectorIsTheNearestToAGuess) {
    const auto found = [](const Vector3d& of, const Vector3d& guess) {
        return Vector3d(rotation_vector(rotation_by(kToRadians * of), kToRadians * guess) / kToRadians);
    };
    const Vector3d aside(0.5, -0.3, 0.4);
    for (const Vector3d& degrees :
         {Vector3d(100, 200, -300), Vector3d(-180, 0, 0), Vector3d(1e-3, 0, 0), Vector3d(0, -1000, 0)})
        EXPECT_LT((found(degrees, degrees + aside) - degrees).norm(), 1e-6) << degrees.transpose();
    EXPECT_LT((found({0, 0, 720}, {0, 0, 700}) - Vector3d(0, 0, 720)).norm(), 1e-6) << "about any axis";
    EXPECT_TRUE(rotation_vector(Eigen::Matrix3d::Identity(), kToRadians * aside).isZero(0.0));
}

}  // namespace
}  // namespace elastolab
