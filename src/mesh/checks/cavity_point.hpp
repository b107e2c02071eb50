#pragma once

#include <Eigen/Core>
#include <span>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// A point well inside a cavity, whose surface is closed, embedded and faces into it. Found by crossing the cavity from
/// a large triangle.
Eigen::Vector3d point_in_cavity(const SurfaceMesh& mesh, std::span<const int> cavity);

}  // namespace elastolab
