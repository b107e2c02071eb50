#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <functional>
#include <span>
#include <vector>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Smallest axis-aligned box around these triangles.
Eigen::AlignedBox3d bounding_box(const SurfaceMesh& mesh, std::span<const int> triangles);

/// Which closed surfaces lie inside which others. components[c] lists the triangles of surface c; the result lists, for
/// each surface, those around it. Orientation does not matter. `apart(c, d)` may say that c cannot lie inside d,
/// because they cross: without it, a part of two crossing surfaces could pass for a cavity of the other.
std::vector<std::vector<int>> surfaces_around(const SurfaceMesh& mesh, const std::vector<std::vector<int>>& components,
                                              const std::function<bool(int, int)>& apart);

}  // namespace elastolab
