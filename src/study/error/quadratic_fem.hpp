#pragma once

#include <array>
#include <Eigen/Core>
#include <map>
#include <span>
#include <vector>

#include "elasticity/material.hpp"
#include "fem/sparse_matrix.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Ten-node tetrahedra with straight edges on a tetrahedral mesh: the truth that the three methods are measured
/// against, with an assembly of its own. Nodes are the vertices, then the midpoints of the edges.
struct QuadraticMesh {
    explicit QuadraticMesh(const TetMesh& mesh);

    int n_nodes() const { return static_cast<int>(positions.cols()); }
    /// Node in the middle of an edge of the mesh.
    int midpoint(int a, int b) const { return edges.at({std::min(a, b), std::max(a, b)}); }

    Positions positions;
    Eigen::Matrix<int, 10, Eigen::Dynamic> elements;  ///< corners 0-3, then midpoints of 01 02 03 12 13 23
    std::map<std::array<int, 2>, int> edges;
};

/// 3 * n_nodes square, exact integration (four Gauss points).
SparseMatrix quadratic_stiffness(const QuadraticMesh& mesh, const Material& material);

/// Displacements of all nodes (3 x n_nodes) where those of `nodes` are prescribed (3 x nodes.size()) and the rest is
/// free of load.
Positions solve_quadratic(const QuadraticMesh& mesh, const Material& material, std::span<const int> nodes,
                          const Positions& values);

}  // namespace elastolab
