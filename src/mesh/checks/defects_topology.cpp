#include <algorithm>
#include <array>

#include "mesh/checks/defects.hpp"
#include "mesh/measures.hpp"

namespace elastolab {

using Eigen::Vector3d;

namespace {

/// Whether the triangles around a vertex form more than one fan. Neighbours in a fan share a vertex beside this one.
bool is_hinge(const SurfaceMesh& mesh, int vertex, std::span<const int> around) {
    std::vector<int> reached{0};
    std::vector<bool> seen(around.size(), false);
    if (around.size() > 1) seen[0] = true;
    const auto share = [&](int s, int t) {
        for (const int v : mesh.triangles.col(s))
            if (v != vertex && (mesh.triangles.col(t).array() == v).any()) return true;
        return false;
    };
    for (std::size_t next = 0; next < reached.size(); ++next)
        for (std::size_t i = 0; i < around.size(); ++i)
            if (!seen[i] && share(around[static_cast<std::size_t>(reached[next])], around[i])) {
                seen[i] = true;
                reached.push_back(static_cast<int>(i));
            }
    return around.size() > 1 && reached.size() < around.size();
}

}  // namespace

void report_non_finite(const SurfaceMesh& mesh, MeshReport& report) {
    DefectCount found;
    for (int v = 0; v < mesh.n_vertices(); ++v)
        if (!(mesh.vertices.col(v).array().abs() <= kLargestCoordinate).all()) found.add(mesh.vertices.col(v));
    found.report_fatal(report, Defect::Kind::non_finite,
                       "vertex has a coordinate that is not a finite number up to 1e90",
                       "vertices have coordinates that are not finite numbers up to 1e90", ". Export the mesh again.");
}

void report_unreferenced(const SurfaceMesh& mesh, MeshReport& report) {
    std::vector<bool> used(static_cast<std::size_t>(mesh.n_vertices()), false);
    for (const int v : mesh.triangles.reshaped()) used[static_cast<std::size_t>(v)] = true;
    DefectCount found;
    for (int v = 0; v < mesh.n_vertices(); ++v)
        if (!used[static_cast<std::size_t>(v)]) found.add(mesh.vertices.col(v));
    found.report_fatal(report, Defect::Kind::unreferenced_vertices, "vertex belongs to no triangle",
                       "vertices belong to no triangle", ". Remove what no triangle uses.");
}

void report_collapsed(const SurfaceMesh& mesh, MeshReport& report) {
    DefectCount found;
    for (int t = 0; t < mesh.n_triangles(); ++t) {
        const Eigen::Vector3i v = mesh.triangles.col(t);
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) found.add(centroid(mesh, t));
    }
    found.report_fatal(report, Defect::Kind::degenerate_triangles, "triangle has two corners at the same place",
                       "triangles have two corners at the same place", ". Remove degenerate triangles and reload.");
}

void report_edges(const SurfaceMesh& mesh, const EdgeTable& edges, MeshReport& report) {
    DefectCount open, crowded;
    for (int e = 0; e < edges.size(); ++e) {
        const Vector3d middle = 0.5 * (mesh.vertices.col(edges[e].a) + mesh.vertices.col(edges[e].b));
        const std::size_t n_uses = edges.half_edges(e).size();
        if (n_uses == 1) open.add(middle);
        if (n_uses > 2) crowded.add(middle);
    }
    open.report_fatal(report, Defect::Kind::open_edges, "open edge", "open edges",
                      ", so it bounds no solid. Fill the holes and reload.");
    crowded.report_fatal(report, Defect::Kind::non_manifold_edges, "edge of more than two triangles",
                         "edges of more than two triangles",
                         ", so inside and outside are unclear. Separate the parts or remove inner faces.");
}

void report_hinges(const SurfaceMesh& mesh, MeshReport& report) {
    const VertexTriangles around(mesh);
    DefectCount found;
    for (int v = 0; v < mesh.n_vertices(); ++v)
        if (is_hinge(mesh, v, around[v])) found.add(mesh.vertices.col(v));
    found.report_fatal(report, Defect::Kind::non_manifold_vertices, "vertex joins parts of the surface by a point only",
                       "vertices join parts of the surface by a point only",
                       ", a hinge and not a solid. Separate the parts or join them by more.");
}

void report_duplicates(const SurfaceMesh& mesh, MeshReport& report) {
    std::vector<std::pair<std::array<int, 3>, int>> sorted;
    for (int t = 0; t < mesh.n_triangles(); ++t) {
        std::array<int, 3> v{mesh.triangles(0, t), mesh.triangles(1, t), mesh.triangles(2, t)};
        std::sort(v.begin(), v.end());
        sorted.emplace_back(v, t);
    }
    std::sort(sorted.begin(), sorted.end());
    DefectCount found;
    for (std::size_t i = 1; i < sorted.size(); ++i)
        if (sorted[i].first == sorted[i - 1].first) found.add(centroid(mesh, sorted[i].second));
    found.report_fatal(report, Defect::Kind::duplicate_triangles, "triangle repeats another", "triangles repeat others",
                       ". Remove duplicate faces and reload.");
}

}  // namespace elastolab
