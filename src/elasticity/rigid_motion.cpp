#include "elasticity/rigid_motion.hpp"

#include <Eigen/Geometry>
#include <utility>

#include "base/lapack.hpp"

namespace elastolab {

Eigen::VectorXd rigid_motion(const Eigen::Matrix3Xd& points, const Eigen::Vector3d& a, const Eigen::Vector3d& omega) {
    Eigen::Matrix3Xd u(3, points.cols());
    for (Eigen::Index i = 0; i < points.cols(); ++i) u.col(i) = a + omega.cross(points.col(i));
    return u.reshaped();
}

Eigen::MatrixXd rigid_modes(const Eigen::Matrix3Xd& points) {
    // Centred and scaled, so that rotations are as large as translations whatever the units and the place of the body.
    const Eigen::Vector3d centre = points.rowwise().mean();
    const Eigen::Matrix3Xd centred = points.colwise() - centre;
    const double scale = centred.norm() > 0.0 ? std::sqrt(static_cast<double>(points.cols())) / centred.norm() : 1.0;
    Eigen::MatrixXd modes(points.size(), 6);
    for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
        modes.col(axis) = rigid_motion(centred, unit, Eigen::Vector3d::Zero());
        modes.col(3 + axis) = rigid_motion(scale * centred, Eigen::Vector3d::Zero(), unit);
    }
    return QrFactorization(std::move(modes)).times_Q(Eigen::MatrixXd::Identity(6, 6));
}

}  // namespace elastolab
