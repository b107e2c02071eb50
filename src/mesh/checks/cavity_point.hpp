#pragma once

#include <Eigen/Core>
#include <span>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// A point well inside the space that this closed, embedded surface bounds on the side its triangles face away from the
/// solid: for a cavity (facing inward), a point in the hole. Found by crossing the hole from a large triangle.
Eigen::Vector3d point_in_cavity(const SurfaceMesh& mesh, std::span<const int> cavity);

}  // namespace elastolab
