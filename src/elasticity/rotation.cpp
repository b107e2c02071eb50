#include "elasticity/rotation.hpp"

#include <cmath>
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <numbers>

namespace elastolab {

namespace {

constexpr double kNoRotation = 1e-9;  ///< what rounding leaves of none [radians]

}  // namespace

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
    Eigen::Matrix3d W;
    W << 0.0, -v[2], v[1], v[2], 0.0, -v[0], -v[1], v[0], 0.0;
    return W;
}

Eigen::Matrix3d rotation_by(const Eigen::Vector3d& turn) {
    const double angle = turn.stableNorm();
    if (angle < 1e-300) return Eigen::Matrix3d::Identity();
    return Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
}

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& map) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(map, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix3d U = svd.matrixU();
    if ((U * svd.matrixV().transpose()).determinant() < 0.0) U.col(2) *= -1.0;  // that of the smallest stretch
    return U * svd.matrixV().transpose();
}

Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& guess) {
    const Eigen::AngleAxisd least(rotation);
    // Near no rotation at all, whole turns may be about any axis.
    const bool any_axis = least.angle() < kNoRotation && guess.norm() > std::numbers::pi;
    const Eigen::Vector3d axis = any_axis ? guess.normalized() : least.axis();
    constexpr double kTurn = 2.0 * std::numbers::pi;
    const double angle = any_axis ? 0.0 : least.angle();
    return (angle + kTurn * std::round((axis.dot(guess) - angle) / kTurn)) * axis;
}

}  // namespace elastolab
