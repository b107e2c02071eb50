#pragma once

#include <Eigen/Core>

#include "elasticity/material.hpp"

namespace elastolab {

/// Kelvin displacement kernel: displacement at y due to a unit point force at x in a full space.
///   U = [ (3-4nu) I + e e^T ] / (16 pi mu (1-nu) r),   r = |y - x|,  e = (y - x) / r
/// x, y    source and field point [L];  x != y (asserted);  poisson_ratio <= 1/2
/// returns 3 x 3, symmetric [L / force], entry (i, j) is displacement component j for a force along axis i
/// Source: docs/formulation.md [1].
Eigen::Matrix3d kelvin_displacement(const Eigen::Vector3d& x, const Eigen::Vector3d& y, const Material& material);

/// Kelvin traction kernel: traction at y, on the plane with normal n, due to a unit point force at x in a full space.
///   T = -[ dr/dn ((1-2nu) I + 3 e e^T) - (1-2nu)(e n^T - n e^T) ] / (8 pi (1-nu) r^2),   r = |y - x|,  e = (y - x) / r
/// x, y    source and field point [L];  x != y (asserted)
/// n       unit normal at y, pointing out of the body
/// returns 3 x 3 [1/L^2], entry (i, j) is traction component j for a force along axis i
/// Over a closed surface around x, T integrates to -I.
/// Source: docs/formulation.md [1].
Eigen::Matrix3d kelvin_traction(const Eigen::Vector3d& x, const Eigen::Vector3d& y, const Eigen::Vector3d& n,
                                double nu);

}  // namespace elastolab
