#pragma once

#include <Eigen/Core>

#include "elasticity/triangle_kernels.hpp"

namespace elastolab {

/// Surface curls n x grad phi_k of the three hats, one a column [1/L]: minus the opposite edge over twice the area.
Eigen::Matrix3d hat_curls(const TriangleGeometry& triangle);

}  // namespace elastolab
