#pragma once

#include <Eigen/Core>

namespace elastolab {

/// Orthonormal basis of the six infinitesimal rigid motions of a set of points.
/// points  3 x n [L], not all on one line (n >= 3)
/// returns 3n x 6, node-major rows; the columns span {a + omega x p} and are orthonormal in R^3n.
Eigen::MatrixXd rigid_modes(const Eigen::Matrix3Xd& points);

/// Displacements a + omega x p of the points: 3n, node-major.
Eigen::VectorXd rigid_motion(const Eigen::Matrix3Xd& points, const Eigen::Vector3d& a, const Eigen::Vector3d& omega);

}  // namespace elastolab
