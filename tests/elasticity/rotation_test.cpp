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

TEST(Rotation, ThatIsNearestToAMapIsItsPolarFactor) {
    const Eigen::Matrix3d R = rotation_by({0.4, -1.1, 0.7});
    Eigen::Matrix3d stretch;
    stretch << 2.0, 0.3, -0.2, 0.3, 1.0, 0.1, -0.2, 0.1, 0.5;
    EXPECT_LT((nearest_rotation(R * stretch) - R).norm(), 1e-14);
    EXPECT_LT((nearest_rotation(1e-200 * R) - R).norm(), 1e-14);
}

TEST(Rotation, ThatIsNearestToAMirroringMapIsNoMirror) {
    Eigen::Matrix3d map;
    map << 1.0, 0.2, 0.0, -0.1, -2.0, 0.3, 0.4, 0.0, 3.0;
    const Eigen::Matrix3d R = nearest_rotation(map);
    EXPECT_NEAR(R.determinant(), 1.0, 1e-14);
    for (const Vector3d& turn : {Vector3d(0.1, 0, 0), Vector3d(0, -0.1, 0), Vector3d(0, 0, 0.1), Vector3d(1, -2, 0.5)})
        EXPECT_GT((rotation_by(turn) * R - map).norm(), (R - map).norm());
}

}  // namespace
}  // namespace elastolab
