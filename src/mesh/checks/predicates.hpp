#pragma once

#include <Eigen/Core>

namespace elastolab {

/// Sign of det(b - a, c - a, d - a), exactly, whatever the rounding: 1 when d is on the side of the plane a b c that
/// its normal (b - a) x (c - a) points to, -1 on the other, 0 exactly in the plane.
/// Fast when the rounded determinant is beyond its error bound, exact in expansions otherwise. Coordinates must be
/// between 1e-90 and 1e90 in magnitude, or zero: products of three must neither overflow nor underflow.
/// Source: J. R. Shewchuk, Adaptive precision floating-point arithmetic and fast robust geometric predicates,
/// Discrete & Computational Geometry 18, 1997.
int orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d);

/// Sign of det(b - a, c - a) in the plane, exactly: 1 when a, b, c turn counter-clockwise, 0 on a line.
int orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

}  // namespace elastolab
