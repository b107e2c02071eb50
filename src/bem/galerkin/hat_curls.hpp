#pragma once

#include <Eigen/Core>
#include <vector>

#include "bem/boundary.hpp"

namespace elastolab {

/// Triangles along a space-filling (Morton) curve through their centroids: neighbours in the list are neighbours in
/// space, however the mesh is numbered.
std::vector<int> triangles_along_a_curve(const Boundary& boundary, const std::vector<int>& triangles);
std::vector<int> triangles_along_a_curve(const Boundary& boundary);

/// Surface curls n x grad phi_k of the three hats, one a column [1/L]: minus the opposite edge over twice the area.
Eigen::Matrix3d hat_curls(const TriangleGeometry& triangle);

}  // namespace elastolab
