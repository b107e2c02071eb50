#pragma once

#include <algorithm>
#include <cmath>
#include <Eigen/Core>
#include <Eigen/LU>
#include <numeric>
#include <random>
#include <vector>

#include "mesh/primitives.hpp"
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

/// Without the triangles whose middles lie beyond a plane (x . direction > offset).
inline SurfaceMesh with_hole(const SurfaceMesh& mesh, const Eigen::Vector3d& direction, double offset) {
    std::vector<int> kept;
    for (int t = 0; t < mesh.n_triangles(); ++t)
        if (mesh.vertices(Eigen::all, mesh.triangles.col(t)).rowwise().mean().dot(direction) <= offset)
            kept.push_back(t);
    return {mesh.vertices, mesh.triangles(Eigen::all, kept)};
}

/// Every third triangle faces the other way, every fifth is there twice.
inline SurfaceMesh carelessly_exported(const SurfaceMesh& mesh) {
    SurfaceMesh careless = mesh;
    for (int t = 0; t < mesh.n_triangles(); t += 3) careless.triangles.col(t).reverseInPlace();
    std::vector<int> all(static_cast<std::size_t>(mesh.n_triangles()));
    std::iota(all.begin(), all.end(), 0);
    for (int t = 0; t < mesh.n_triangles(); t += 5) all.push_back(t);
    careless.triangles = careless.triangles(Eigen::all, all).eval();
    return careless;
}

/// Every triangle has vertices of its own, moved by at most `gap` along each axis: nothing hangs together.
inline SurfaceMesh torn(const SurfaceMesh& mesh, double gap) {
    SurfaceMesh pieces{Positions(3, 3 * mesh.n_triangles()), Triangles(3, mesh.n_triangles())};
    std::mt19937 random(3);
    std::uniform_real_distribution<double> shift(-gap, gap);
    for (int t = 0; t < mesh.n_triangles(); ++t)
        for (int i = 0; i < 3; ++i) {
            const Eigen::Vector3d by(shift(random), shift(random), shift(random));
            pieces.vertices.col(3 * t + i) = mesh.vertices.col(mesh.triangles(i, t)) + by;
            pieces.triangles(i, t) = 3 * t + i;
        }
    return pieces;
}

/// A ball with smooth lumps, like no mirror image or turn of itself.
inline SurfaceMesh make_lumpy_ball(int cells) {
    SurfaceMesh mesh = make_sphere(cells);
    for (auto p : mesh.vertices.colwise())
        p *= 1.0 + 0.2 * std::sin(2.0 * p[0] + 1.0) + 0.15 * std::sin(3.0 * p[1] - p[2]) + 0.1 * std::cos(2.0 * p[2]);
    return mesh;
}

/// A body renumbered, and turned, mirrored and scaled by a matrix.
struct Disguised {
    SurfaceMesh mesh;
    std::vector<int> place;  ///< of each vertex of the original

    /// seed: of the numbering; 0 keeps it
    Disguised(const SurfaceMesh& original, const Eigen::Matrix3d& turn, unsigned seed = 0)
        : mesh(original), place(static_cast<std::size_t>(original.n_vertices())) {
        std::iota(place.begin(), place.end(), 0);
        std::vector<int> order(static_cast<std::size_t>(original.n_triangles()));
        std::iota(order.begin(), order.end(), 0);
        if (seed != 0) {
            std::mt19937 random(seed);
            std::shuffle(place.begin(), place.end(), random);
            std::shuffle(order.begin(), order.end(), random);
        }
        for (int v = 0; v < original.n_vertices(); ++v)
            mesh.vertices.col(place[static_cast<std::size_t>(v)]) = turn * original.vertices.col(v);
        for (int t = 0; t < original.n_triangles(); ++t)
            for (int i = 0; i < 3; ++i)  // triangles begin elsewhere, too
                mesh.triangles((i + (seed != 0 ? t : 0)) % 3, t) =
                    place[static_cast<std::size_t>(original.triangles(i, order[static_cast<std::size_t>(t)]))];
        if (turn.determinant() < 0.0) mesh = inside_out(mesh);
    }
};

/// Mirrors, turns by right angles, factors, alone and together.
inline std::vector<Eigen::Matrix3d> disguises() {
    Eigen::Matrix3d mirror = Eigen::Vector3d(-1.0, 1.0, 1.0).asDiagonal(), swap, turn, cycle;
    swap << 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0;
    turn << 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0;
    cycle << 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0;
    const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
    return {one, mirror, swap, turn, cycle, -one, 8.0 * one, 0.3 * one, 1e5 * (turn * cycle), -0.07 * (cycle * turn)};
}

}  // namespace elastolab
