#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "deform/unit_load.hpp"
#include "fem/quadratic_mesh.hpp"
#include "fem/sparse_matrix.hpp"

// Quadratic elements with all edges halved, by which the given ones are judged: eight in place of each.

namespace elastolab {

/// split: the given elements by QuadraticMesh::split. Vertices of the new surface are all nodes of the given one.
QuadraticMesh halved_mesh(TetMesh split, int n_surface_nodes);

/// Values of the given nodes at those of the new elements: 3 n_new x 3 n_given. elements: the given ones, 10 rows.
SparseMatrix from_whole(const QuadraticMesh& halved, const Eigen::MatrixXi& elements);

/// Four triangles of the surface in place of each, and the same tractions on them: triangle t becomes 4 t to 4 t + 3.
Triangles quarters(const Triangles& triangles, const Triangles& midpoints);
std::vector<UnitLoad> on_quarters(std::span<const UnitLoad> loads);

}  // namespace elastolab
