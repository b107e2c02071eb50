#include "fem/quadratic_mesh.hpp"

#include <algorithm>
#include <array>
#include <cassert>

#include "mesh/tets/boundary.hpp"

namespace elastolab {

namespace {

/// The nodes of an element's parts: one at each corner, and the octahedron between cut along the line from node 5 to 8.
constexpr int kParts[8][4] = {{0, 4, 5, 6}, {4, 1, 7, 8}, {5, 7, 2, 9}, {6, 8, 9, 3},
                              {4, 5, 6, 8}, {4, 7, 5, 8}, {5, 9, 6, 8}, {5, 7, 9, 8}};

std::uint64_t key(int a, int b) {
    return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | static_cast<std::uint64_t>(std::max(a, b));
}

std::vector<std::uint64_t> sorted_unique(std::vector<std::uint64_t> keys) {
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    return keys;
}

std::vector<std::uint64_t> edges_of(const Tetrahedra& tetrahedra) {
    std::vector<std::uint64_t> keys;
    for (const auto& t : tetrahedra.colwise())
        for (const auto& [a, b] : kTetEdges) keys.push_back(key(t[a], t[b]));
    return sorted_unique(std::move(keys));
}

std::vector<std::uint64_t> edges_of(const Triangles& triangles) {
    std::vector<std::uint64_t> keys;
    for (const auto& t : triangles.colwise())
        for (int i = 0; i < 3; ++i) keys.push_back(key(t[i], t[(i + 1) % 3]));
    return sorted_unique(std::move(keys));
}

}  // namespace

QuadraticMesh::QuadraticMesh(const TetMesh& mesh)
    : n_surface_vertices(mesh.n_surface_vertices),
      triangles(boundary_triangles(mesh)),
      edges_(edges_of(mesh.tetrahedra)) {
    const std::vector<std::uint64_t> on_surface = edges_of(triangles);
    n_surface_nodes = n_surface_vertices + static_cast<int>(on_surface.size());
    const int shift = n_surface_nodes - n_surface_vertices;
    const auto node_of = [&](int vertex) { return vertex < n_surface_vertices ? vertex : vertex + shift; };

    positions.resize(3, mesh.n_vertices() + std::ssize(edges_));
    for (int v = 0; v < mesh.n_vertices(); ++v) positions.col(node_of(v)) = mesh.vertices.col(v);
    int next_on_surface = n_surface_vertices, next_inside = mesh.n_vertices() + shift;
    for (const std::uint64_t edge : edges_) {
        const bool outside = std::binary_search(on_surface.begin(), on_surface.end(), edge);
        nodes_.push_back(outside ? next_on_surface++ : next_inside++);
        positions.col(nodes_.back()) =
            0.5 * (mesh.vertices.col(static_cast<int>(edge >> 32)) + mesh.vertices.col(static_cast<int>(edge & ~0u)));
    }
    assert(next_on_surface == n_surface_nodes);

    elements.resize(10, mesh.n_tetrahedra());
    for (int t = 0; t < mesh.n_tetrahedra(); ++t) {
        const Eigen::Vector4i corners = mesh.tetrahedra.col(t);
        for (int c = 0; c < 4; ++c) elements(c, t) = node_of(corners[c]);
        for (int e = 0; e < 6; ++e) elements(4 + e, t) = midpoint(corners[kTetEdges[e][0]], corners[kTetEdges[e][1]]);
    }
    midpoints.resize(3, triangles.cols());
    for (Eigen::Index t = 0; t < triangles.cols(); ++t)
        for (int i = 0; i < 3; ++i) midpoints(i, t) = midpoint(triangles(i, t), triangles((i + 1) % 3, t));
}

int QuadraticMesh::midpoint(int a, int b) const {
    const auto found = std::lower_bound(edges_.begin(), edges_.end(), key(a, b));
    assert(found != edges_.end() && *found == key(a, b));
    return nodes_[static_cast<std::size_t>(found - edges_.begin())];
}

TetMesh QuadraticMesh::split() const {
    TetMesh mesh{positions, Tetrahedra(4, 8 * elements.cols()), n_surface_vertices};
    for (Eigen::Index t = 0; t < elements.cols(); ++t)
        for (int part = 0; part < 8; ++part)
            for (int c = 0; c < 4; ++c) mesh.tetrahedra(c, 8 * t + part) = elements(kParts[part][c], t);
    return mesh;
}

Eigen::Matrix<int, 10, Eigen::Dynamic> rejoined(const TetMesh& split) {
    // Where the ten nodes are first seen, in the four parts at the corners: part, corner of it.
    constexpr std::array<std::array<int, 2>, 10> kSeen = {
        {{0, 0}, {1, 1}, {2, 2}, {3, 3}, {0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
    Eigen::Matrix<int, 10, Eigen::Dynamic> elements(10, split.n_tetrahedra() / 8);
    for (Eigen::Index t = 0; t < elements.cols(); ++t)
        for (std::size_t i = 0; i < kSeen.size(); ++i)
            elements(static_cast<Eigen::Index>(i), t) = split.tetrahedra(kSeen[i][1], 8 * t + kSeen[i][0]);
    return elements;
}

Eigen::Vector4d in_whole(int part, const Eigen::Vector4d& weights) {
    Eigen::Vector4d L = Eigen::Vector4d::Zero();
    for (int c = 0; c < 4; ++c) L += weights[c] * node_coordinates(kParts[part][c]);
    return L;
}

Eigen::Matrix<double, 10, 1> quadratic_shapes(const Eigen::Vector4d& L) {
    Eigen::Matrix<double, 10, 1> N;
    for (int c = 0; c < 4; ++c) N[c] = L[c] * (2.0 * L[c] - 1.0);
    for (int e = 0; e < 6; ++e) N[4 + e] = 4.0 * L[kTetEdges[e][0]] * L[kTetEdges[e][1]];
    return N;
}

Eigen::Matrix<double, 10, 4> quadratic_slopes(const Eigen::Vector4d& L) {
    Eigen::Matrix<double, 10, 4> slopes = Eigen::Matrix<double, 10, 4>::Zero();
    for (int c = 0; c < 4; ++c) slopes(c, c) = 4.0 * L[c] - 1.0;
    for (int e = 0; e < 6; ++e) {
        const auto [a, b] = kTetEdges[e];
        slopes(4 + e, a) = 4.0 * L[b];
        slopes(4 + e, b) = 4.0 * L[a];
    }
    return slopes;
}

Eigen::Vector4d node_coordinates(int node) {
    if (node < 4) return Eigen::Vector4d::Unit(node);
    return 0.5 * (Eigen::Vector4d::Unit(kTetEdges[node - 4][0]) + Eigen::Vector4d::Unit(kTetEdges[node - 4][1]));
}

}  // namespace elastolab
