#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <vector>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// The edges of a tetrahedron as ten-node elements number their midpoints: node 4 + e lies between these corners.
constexpr int kTetEdges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

/// Ten-node tetrahedra with straight edges on the tetrahedra of a mesh. Its nodes are, in this order,
///   the vertices of the surface, the midpoints of the surface's edges, the vertices inside, all other midpoints,
/// so that those shown come first, and those that may be prescribed or loaded before those that may not.
class QuadraticMesh {
public:
    explicit QuadraticMesh(const TetMesh& mesh);

    int n_nodes() const { return static_cast<int>(positions.cols()); }
    /// Node in the middle of an edge of the mesh between these two of its vertices.
    int midpoint(int a, int b) const;
    /// Every element as eight of four nodes, on the same nodes: what the inside is shown by. Its surface vertices are
    /// those of the mesh it was made from; the midpoints on the surface count as inside.
    TetMesh split() const;

    Positions positions;                              ///< 3 x n_nodes
    Eigen::Matrix<int, 10, Eigen::Dynamic> elements;  ///< corners, positively oriented, then midpoints by kTetEdges
    int n_surface_vertices = 0;
    int n_surface_nodes = 0;  ///< surface vertices and midpoints of surface edges
    Triangles triangles;      ///< of the surface: vertices
    Triangles midpoints;      ///< the nodes between its vertices 0 and 1, 1 and 2, 2 and 0

private:
    std::vector<std::uint64_t> edges_;  ///< both vertices in one number, ascending
    std::vector<int> nodes_;            ///< midpoint of each
};

/// The ten nodes of each element, recovered from the eight parts that it was split into.
Eigen::Matrix<int, 10, Eigen::Dynamic> rejoined(const TetMesh& split);

/// Barycentric coordinates in an element of a point that has `weights` in one of its eight parts.
Eigen::Vector4d in_whole(int part, const Eigen::Vector4d& weights);

/// The shape functions of the ten nodes at barycentric coordinates, and their derivatives with respect to each of these
/// (10 x 4).
Eigen::Matrix<double, 10, 1> quadratic_shapes(const Eigen::Vector4d& L);
Eigen::Matrix<double, 10, 4> quadratic_slopes(const Eigen::Vector4d& L);

/// Barycentric coordinates of a node, 0 to 9.
Eigen::Vector4d node_coordinates(int node);

}  // namespace elastolab
