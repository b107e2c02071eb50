#pragma once

#include <Eigen/Core>

namespace elastolab {

/// The matrix that multiplies from the left by a cross product: cross_matrix(v) w = v x w.
Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v);

/// The rotation about a rotation vector's direction by its length [radians].
Eigen::Matrix3d rotation_by(const Eigen::Vector3d& turn);

/// The rotation R that is nearest to a map, by the sum of the squares of the entries of R - map. Of a map that does not
/// mirror it is the factor of the polar decomposition, map = R * stretch.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& map);

/// Of the rotation vectors of a rotation, which are whole turns apart, the one that is nearest to `guess` [radians].
Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& guess);

}  // namespace elastolab
