#include "mesh/refine.hpp"

#include <algorithm>
#include <cassert>
#include <Eigen/Geometry>
#include <map>
#include <set>
#include <utility>

namespace elastolab {

namespace {

using Edge = std::pair<int, int>;
Edge edge_of(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// The parts of a triangle, given the new vertices on its edges 01, 12, 20 (-1: not split).
std::vector<Eigen::Vector3i> parts(const Eigen::Vector3i& v, const Eigen::Vector3i& middle) {
    const auto n_split = (middle.array() >= 0).count();
    if (n_split == 0) return {v};
    if (n_split == 3)
        return {{v[0], middle[0], middle[2]}, {middle[0], v[1], middle[1]}, {middle[2], middle[1], v[2]}, middle};
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        if (n_split == 1 && middle[i] >= 0) return {{v[i], middle[i], v[k]}, {middle[i], v[j], v[k]}};
        if (n_split == 2 && middle[i] < 0)  // edge ij is whole; k is the corner between the two new vertices
            return {{middle[j], v[k], middle[k]}, {v[i], v[j], middle[j]}, {v[i], middle[j], middle[k]}};
    }
    return {v};
}

}  // namespace

Eigen::Matrix3Xd RefinedSurface::gather(Eigen::Matrix3Xd loads) const {
    const Eigen::Index n_coarse = mesh.n_vertices() - std::ssize(cuts);
    for (Eigen::Index v = loads.cols() - 1; v >= n_coarse; --v)
        for (const std::size_t end : {0, 1}) {
            const EdgeCut& cut = cuts[static_cast<std::size_t>(v - n_coarse)];
            loads.col(cut.ends[end]) += cut.weight(end) * loads.col(v).eval();
        }
    return loads.leftCols(n_coarse);
}

Eigen::Matrix3Xd RefinedSurface::interpolate(const Eigen::Matrix3Xd& coarse) const {
    const Eigen::Index n = mesh.n_vertices() - std::ssize(cuts);
    assert(coarse.cols() == n);
    Eigen::Matrix3Xd values(3, mesh.n_vertices());
    values.leftCols(n) = coarse;
    for (std::size_t i = 0; i < cuts.size(); ++i)
        values.col(n + static_cast<Eigen::Index>(i)) =
            cuts[i].weight(0) * values.col(cuts[i].ends[0]) + cuts[i].weight(1) * values.col(cuts[i].ends[1]);
    return values;
}

SurfaceWeights RefinedSurface::weights() const {
    const int n = mesh.n_vertices(), n_coarse = n - static_cast<int>(cuts.size());
    std::vector<std::map<int, double>> rows(static_cast<std::size_t>(n));
    std::vector<Eigen::Triplet<double>> entries;
    for (int v = 0; v < n; ++v) {
        std::map<int, double>& row = rows[static_cast<std::size_t>(v)];
        if (v < n_coarse) row[v] = 1.0;
        for (std::size_t end = 0; end < 2 && v >= n_coarse; ++end) {
            const EdgeCut& cut = cuts[static_cast<std::size_t>(v - n_coarse)];
            for (const auto& [of, weight] : rows[static_cast<std::size_t>(cut.ends[end])])
                row[of] += cut.weight(end) * weight;
        }
        for (const auto& [of, weight] : row) entries.emplace_back(v, of, weight);
    }
    SurfaceWeights weights(n, n_coarse);
    weights.setFromTriplets(entries.begin(), entries.end());
    return weights;
}

RefinedSurface unrefined(const SurfaceMesh& mesh) {
    RefinedSurface surface{mesh, {}, {}};
    for (int t = 0; t < mesh.n_triangles(); ++t) surface.coarse_triangle.push_back(t);
    return surface;
}

RefinedSurface cut_edges(const RefinedSurface& surface, const std::vector<EdgeCut>& cuts) {
    if (cuts.empty()) return surface;
    const Triangles& triangles = surface.mesh.triangles;
    const int n_old = surface.mesh.n_vertices(), n = n_old + static_cast<int>(cuts.size());
    RefinedSurface fine;
    fine.cuts = surface.cuts;
    fine.cuts.insert(fine.cuts.end(), cuts.begin(), cuts.end());
    std::map<Edge, int> new_vertex;
    for (std::size_t i = 0; i < cuts.size(); ++i)
        new_vertex[edge_of(cuts[i].ends[0], cuts[i].ends[1])] = n_old + static_cast<int>(i);
    std::vector<Eigen::Vector3i> all;
    for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
        Eigen::Vector3i middle;
        for (int i = 0; i < 3; ++i) {
            const auto found = new_vertex.find(edge_of(triangles(i, t), triangles((i + 1) % 3, t)));
            middle[i] = found == new_vertex.end() ? -1 : found->second;
        }
        for (const Eigen::Vector3i& part : parts(triangles.col(t), middle)) {
            all.push_back(part);
            fine.coarse_triangle.push_back(surface.coarse_triangle[static_cast<std::size_t>(t)]);
        }
    }
    fine.mesh.triangles.resize(3, std::ssize(all));
    for (std::size_t i = 0; i < all.size(); ++i) fine.mesh.triangles.col(static_cast<Eigen::Index>(i)) = all[i];
    fine.mesh.vertices.resize(3, n);
    const Eigen::Index n_coarse = n - std::ssize(fine.cuts);
    fine.mesh.vertices = fine.interpolate(surface.mesh.vertices.leftCols(n_coarse));
    return fine;
}

RefinedSurface refine_marked(const RefinedSurface& surface, const std::vector<char>& marked) {
    const Triangles& triangles = surface.mesh.triangles;
    std::set<Edge> halved;
    std::vector<EdgeCut> cuts;
    for (Eigen::Index t = 0; t < triangles.cols(); ++t)
        for (int i = 0; i < 3 && marked[static_cast<std::size_t>(t)]; ++i) {
            const Edge edge = edge_of(triangles(i, t), triangles((i + 1) % 3, t));
            if (halved.insert(edge).second) cuts.push_back({{edge.first, edge.second}});
        }
    return cut_edges(surface, cuts);
}

RefinedSurface refine_all(const RefinedSurface& surface) {
    return refine_marked(surface, std::vector<char>(static_cast<std::size_t>(surface.mesh.n_triangles()), 1));
}

TetMesh refine_tetrahedra(const TetMesh& mesh, const RefinedSurface& fine) {
    const int n_surface = fine.mesh.n_vertices(), shift = n_surface - mesh.n_surface_vertices;
    const auto number = [&](int v) { return v < mesh.n_surface_vertices ? v : v + shift; };
    std::map<Edge, int> midpoints;
    const int first_new = n_surface - static_cast<int>(fine.cuts.size());
    for (std::size_t i = 0; i < fine.cuts.size(); ++i)
        midpoints[edge_of(fine.cuts[i].ends[0], fine.cuts[i].ends[1])] = first_new + static_cast<int>(i);
    std::vector<Eigen::Vector3d> positions(static_cast<std::size_t>(mesh.n_vertices() + shift));
    for (int v = 0; v < mesh.n_vertices(); ++v) positions[static_cast<std::size_t>(number(v))] = mesh.vertices.col(v);
    for (int v = 0; v < n_surface; ++v) positions[static_cast<std::size_t>(v)] = fine.mesh.vertices.col(v);
    const auto at = [&](int v) { return positions[static_cast<std::size_t>(v)]; };
    const auto midpoint = [&](int a, int b) {
        const auto [place, is_new] = midpoints.try_emplace(edge_of(a, b), static_cast<int>(positions.size()));
        if (is_new) positions.push_back(0.5 * (at(a) + at(b)));
        return place->second;
    };
    TetMesh result;
    result.n_surface_vertices = n_surface;
    result.tetrahedra.resize(4, 8 * mesh.n_tetrahedra());
    Eigen::Index next = 0;
    const auto add = [&](int a, int b, int c, int d) {
        const bool positive = (at(b) - at(a)).cross(at(c) - at(a)).dot(at(d) - at(a)) > 0.0;
        result.tetrahedra.col(next++) << a, b, positive ? c : d, positive ? d : c;
    };
    for (const auto& tet : mesh.tetrahedra.colwise()) {
        const std::array<int, 4> v = {number(tet[0]), number(tet[1]), number(tet[2]), number(tet[3])};
        const int m01 = midpoint(v[0], v[1]), m02 = midpoint(v[0], v[2]), m03 = midpoint(v[0], v[3]);
        const int m12 = midpoint(v[1], v[2]), m13 = midpoint(v[1], v[3]), m23 = midpoint(v[2], v[3]);
        add(v[0], m01, m02, m03);
        add(m01, v[1], m12, m13);
        add(m02, m12, v[2], m23);
        add(m03, m13, m23, v[3]);
        // Each diagonal of the octahedron and the ring of four midpoints around it.
        const std::array<std::array<int, 6>, 3> diagonals = {
            {{m01, m23, m02, m03, m13, m12}, {m02, m13, m01, m03, m23, m12}, {m03, m12, m01, m02, m23, m13}}};
        const auto length = [&](const auto& d) { return (at(d[0]) - at(d[1])).norm(); };
        const auto& cut = *std::min_element(diagonals.begin(), diagonals.end(),
                                            [&](const auto& a, const auto& b) { return length(a) < length(b); });
        for (std::size_t i = 0; i < 4; ++i) add(cut[0], cut[1], cut[2 + i], cut[2 + (i + 1) % 4]);
    }
    result.vertices.resize(3, std::ssize(positions));
    for (std::size_t v = 0; v < positions.size(); ++v) result.vertices.col(static_cast<Eigen::Index>(v)) = positions[v];
    return result;
}

}  // namespace elastolab
