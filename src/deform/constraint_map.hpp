#pragma once

#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "mesh/surface_mesh.hpp"
#include "mesh/topology.hpp"

namespace elastolab {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// How constrained vertices become constrained nodes of a method.
struct ConstrainedNodes {
    std::vector<int> nodes;
    SparseRows prescribe;  ///< 3*nodes.size() x 3*n_constrained_vertices: prescribed displacement of each node
};

/// Every constrained vertex is a node (FEM, linear BEM).
ConstrainedNodes constrain_vertices(std::span<const int> vertices);

/// Constant BEM: a triangle is constrained when all its vertices are, at the mean of their displacements; a vertex
/// with no such triangle constrains the triangles around it, at the mean over such vertices of the triangle.
ConstrainedNodes constrain_triangles(const SurfaceMesh& mesh, const VertexTriangles& around,
                                     std::span<const int> vertices);

/// Constant BEM shows a vertex at the mean of the triangles around it: 3*n_vertices x 3*n_triangles.
SparseRows average_of_triangles(const SurfaceMesh& mesh, const VertexTriangles& around);

}  // namespace elastolab
