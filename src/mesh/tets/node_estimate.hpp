#pragma once

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Nodes of the tetrahedra that tetrahedralize() makes of a surface by its default options, without making them: the
/// wanted edge length is sampled on a grid of points inside. Within 15 % on the bodies of the tests; some 50 ms for
/// 40 000 vertices.
double estimated_tet_nodes(const SurfaceMesh& surface);

}  // namespace elastolab
