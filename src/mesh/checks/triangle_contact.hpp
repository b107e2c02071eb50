#pragma once

#include <Eigen/Core>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Whether two triangles of a mesh, neither degenerate, have points in common beyond the corners or the edge that they
/// share by their vertex numbers. Touching counts. Exact (mesh/checks/predicates.hpp): neighbours are never taken
/// for crossing triangles, while a triangle folded back onto its neighbour is found. Triangles with the same three
/// vertices: false.
bool in_contact(const SurfaceMesh& mesh, int triangle, int other);

/// Whether a triangle has exactly no area.
bool is_degenerate(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

}  // namespace elastolab
