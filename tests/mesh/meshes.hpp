#pragma once

#include <Eigen/Core>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Two meshes in one, unmerged.
inline SurfaceMesh joined(const SurfaceMesh& a, const SurfaceMesh& b) {
    SurfaceMesh mesh{Positions(3, a.n_vertices() + b.n_vertices()), Triangles(3, a.n_triangles() + b.n_triangles())};
    mesh.vertices << a.vertices, b.vertices;
    mesh.triangles << a.triangles, (b.triangles.array() + a.n_vertices()).matrix();
    return mesh;
}

inline SurfaceMesh moved(SurfaceMesh mesh, const Eigen::Vector3d& by) {
    mesh.vertices.colwise() += by;
    return mesh;
}

inline SurfaceMesh scaled(SurfaceMesh mesh, double factor) {
    mesh.vertices *= factor;
    return mesh;
}

inline SurfaceMesh inside_out(SurfaceMesh mesh) {
    mesh.triangles.row(1).swap(mesh.triangles.row(2));
    return mesh;
}

inline SurfaceMesh with_triangle(const SurfaceMesh& mesh, int a, int b, int c) {
    SurfaceMesh more{mesh.vertices, Triangles(3, mesh.n_triangles() + 1)};
    more.triangles << mesh.triangles, Eigen::Vector3i(a, b, c);
    return more;
}

/// The mesh with one more vertex, of no triangle.
inline SurfaceMesh with_vertex(const SurfaceMesh& mesh, const Eigen::Vector3d& p) {
    SurfaceMesh more{Positions(3, mesh.n_vertices() + 1), mesh.triangles};
    more.vertices << mesh.vertices, p;
    return more;
}

/// The mesh without its last n triangles.
inline SurfaceMesh without_last(const SurfaceMesh& mesh, int n) {
    return {mesh.vertices, mesh.triangles.leftCols(mesh.n_triangles() - n)};
}

}  // namespace elastolab
