#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "mesh/checks/defects.hpp"
#include "mesh/measures.hpp"
#include "mesh/numbering.hpp"

namespace elastolab {

using Eigen::Vector3d;

namespace {

/// Whether the triangles around a vertex form more than one fan: whether their other corners, joined when they belong
/// to one triangle, are more than one connected part. Damaged files have vertices of a hundred thousand triangles.
bool is_hinge(const SurfaceMesh& mesh, int vertex, std::span<const int> around) {
    std::vector<int> corners;
    for (const int t : around)
        for (const int v : mesh.triangles.col(t))
            if (v != vertex) corners.push_back(v);
    const std::vector<int> places = each_once(corners);
    std::vector<std::size_t> parent(places.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto root_of = [&](int v) {
        auto i = static_cast<std::size_t>(std::lower_bound(places.begin(), places.end(), v) - places.begin());
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    std::size_t n_parts = places.size();
    for (std::size_t k = 0; k + 1 < corners.size(); k += 2) {  // no triangle has a corner twice
        const std::size_t a = root_of(corners[k]), b = root_of(corners[k + 1]);
        if (a == b) continue;
        parent[a] = b;
        --n_parts;
    }
    return n_parts > 1;
}

}  // namespace

void leave_out_non_finite(SurfaceMesh& mesh, MeshReport& report) {
    DefectCount found;
    std::vector<bool> finite;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int v = 0; v < mesh.n_vertices(); ++v) {
        const auto& vertex = mesh.vertices.col(v);
        finite.push_back((vertex.array().abs() <= kLargestCoordinate).all());
        if (finite.back())
            sum += vertex;
        else
            found.add(vertex);
    }
    if (found.count() == 0) return;
    std::vector<int> kept;
    for (int t = 0; t < mesh.n_triangles(); ++t) {
        const auto& v = mesh.triangles.col(t);
        if (std::all_of(v.begin(), v.end(), [&](int corner) { return finite[static_cast<std::size_t>(corner)]; }))
            kept.push_back(t);
    }
    const auto n_left_out = mesh.n_triangles() - std::ssize(kept);
    const std::string left_out =
        std::to_string(n_left_out) + (n_left_out == 1 ? " triangle there is" : " triangles there are");
    found.report_fatal(report, Defect::Kind::non_finite,
                       "vertex has a coordinate that is not a finite number up to 1e70",
                       "vertices have coordinates that are not finite numbers up to 1e70",
                       "; " + left_out + " left out. Export the mesh again.");
    const Eigen::Vector3d middle = sum / std::max<double>(1.0, mesh.n_vertices() - found.count());
    for (int v = 0; v < mesh.n_vertices(); ++v)
        if (!finite[static_cast<std::size_t>(v)]) mesh.vertices.col(v) = middle;
    mesh.triangles = Triangles(mesh.triangles(Eigen::all, kept));
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
                       ", a hinge and not a solid. Separate the parts or join them along an edge or a face.");
}

std::vector<char> repeats_of_triangles(const SurfaceMesh& mesh) {
    std::vector<std::pair<std::array<int, 3>, int>> sorted;
    for (int t = 0; t < mesh.n_triangles(); ++t) {
        std::array<int, 3> v{mesh.triangles(0, t), mesh.triangles(1, t), mesh.triangles(2, t)};
        std::sort(v.begin(), v.end());
        sorted.emplace_back(v, t);
    }
    std::sort(sorted.begin(), sorted.end());
    std::vector<char> repeats(sorted.size(), 0);
    for (std::size_t i = 1; i < sorted.size(); ++i)
        repeats[static_cast<std::size_t>(sorted[i].second)] = sorted[i].first == sorted[i - 1].first;
    return repeats;
}

void report_duplicates(const SurfaceMesh& mesh, MeshReport& report) {
    const std::vector<char> repeats = repeats_of_triangles(mesh);
    DefectCount found;
    for (int t = 0; t < mesh.n_triangles(); ++t)
        if (repeats[static_cast<std::size_t>(t)]) found.add(centroid(mesh, t));
    found.report_fatal(report, Defect::Kind::duplicate_triangles, "triangle repeats another", "triangles repeat others",
                       ". Remove duplicate faces and reload.");
}

}  // namespace elastolab
