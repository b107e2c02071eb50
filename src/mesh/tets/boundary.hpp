#pragma once

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// The faces that no other tetrahedron shares, outward. Each begins with its smallest vertex; ascending.
Triangles boundary_triangles(const TetMesh& mesh);

/// Triangles as cycles in a canonical order: each begins with its smallest vertex; ascending.
Triangles canonical(const Triangles& triangles);

}  // namespace elastolab
