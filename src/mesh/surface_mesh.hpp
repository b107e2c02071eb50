#pragma once

#include <Eigen/Core>
#include <string>

namespace elastolab {

/// Vertex positions, one column each: 3 x n_vertices [L]. Its memory order is node-major (x0 y0 z0 x1 ...), the order
/// of every vector of degrees of freedom in this program.
using Positions = Eigen::Matrix3Xd;
/// Vertex numbers, one triangle a column: 3 x n_triangles, counter-clockwise seen from outside the body.
using Triangles = Eigen::Matrix3Xi;
/// Vertex numbers, one tetrahedron a column: 4 x n_tetrahedra, positively oriented: det(v1-v0, v2-v0, v3-v0) > 0.
using Tetrahedra = Eigen::Matrix4Xi;

/// A triangulated surface. Whether it bounds a solid is checked by mesh/checks/check.hpp.
struct SurfaceMesh {
    Positions vertices;
    Triangles triangles;

    int n_vertices() const { return static_cast<int>(vertices.cols()); }
    int n_triangles() const { return static_cast<int>(triangles.cols()); }
};

/// A tetrahedral mesh of one solid. Its first n_surface_vertices vertices are those of the surface mesh it was made
/// from, in the same order and at the same places; interior vertices follow.
struct TetMesh {
    Positions vertices;
    Tetrahedra tetrahedra;
    int n_surface_vertices = 0;

    int n_vertices() const { return static_cast<int>(vertices.cols()); }
    int n_tetrahedra() const { return static_cast<int>(tetrahedra.cols()); }
};

}  // namespace elastolab
