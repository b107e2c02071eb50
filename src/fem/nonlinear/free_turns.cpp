#include "fem/nonlinear/free_turns.hpp"

#include <cmath>
#include <Eigen/Geometry>

#include "elasticity/rotation.hpp"

namespace elastolab {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Part of the largest force by which forces of one direction may differ from it.
constexpr double kParallel = 1e-9;

/// The rotation about `axis` that takes `from` nearest to `to`, both about their centres.
Matrix3d nearest_turn_about(const Vector3d& axis, const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to) {
    double sine = 0.0, cosine = 0.0;
    for (Eigen::Index i = 0; i < from.cols(); ++i) {
        const Vector3d a = from.col(i), b = to.col(i);
        sine += axis.dot(a.cross(b));
        cosine += a.dot(b) - axis.dot(a) * axis.dot(b);
    }
    return rotation_by(std::atan2(sine, cosine) * axis);
}

}  // namespace

Eigen::VectorXd turned_to_rest(const Positions& rest, const Eigen::VectorXd& u, const Eigen::Matrix3Xd& dead_forces) {
    const Positions present = rest + u.reshaped(3, rest.cols());
    const Vector3d centre = present.rowwise().mean();
    const Eigen::Matrix3Xd from = present.colwise() - centre, to = rest.colwise() - rest.rowwise().mean();
    Eigen::Index strongest = 0;
    const double force = dead_forces.cols() > 0 ? dead_forces.colwise().norm().maxCoeff(&strongest) : 0.0;
    Matrix3d turn;
    if (force > 0.0) {
        const Vector3d axis = dead_forces.col(strongest) / force;
        const Eigen::RowVectorXd along = axis.transpose() * dead_forces;
        if ((dead_forces - axis * along).cwiseAbs().maxCoeff() > kParallel * force) return u;
        turn = nearest_turn_about(axis, from, to);
    } else {
        turn = nearest_rotation(to * from.transpose());
    }
    return (((turn * from).colwise() + centre) - rest).reshaped();
}

}  // namespace elastolab
