#pragma once

#include <functional>
#include <vector>

#include "deform/deformer.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Reactions at constrained vertices from an exact stress: its traction on the triangles whose vertices are all
/// constrained, spread by their hat functions. Exact totals where the traction is linear and the triangles lie on the
/// true surface. `constrained`: all different; the result is in their order.
Reactions exact_reactions(const SurfaceMesh& mesh, const std::vector<int>& constrained,
                          const std::function<Eigen::Matrix3d(const Eigen::Vector3d&)>& stress);

}  // namespace elastolab
