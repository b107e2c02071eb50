#include "mesh/checks/check.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "mesh/checks/defects.hpp"
#include "mesh/measures.hpp"
#include "mesh/topology.hpp"

namespace elastolab {

namespace {

bool any_fatal(const MeshReport& report) {
    return std::any_of(report.defects.begin(), report.defects.end(), [](const Defect& d) { return d.fatal; });
}

/// The mesh without triangles that have two equal corners: their edges mean nothing.
SurfaceMesh without_collapsed(const SurfaceMesh& mesh) {
    std::vector<int> kept;
    for (int t = 0; t < mesh.n_triangles(); ++t) {
        const Eigen::Vector3i v = mesh.triangles.col(t);
        if (v[0] != v[1] && v[1] != v[2] && v[2] != v[0]) kept.push_back(t);
    }
    return {mesh.vertices, mesh.triangles(Eigen::all, kept)};
}

void measure(const SurfaceMesh& mesh, const EdgeTable& edges, MeshReport& report) {
    report.area = surface_area(mesh);
    report.min_corner = mesh.vertices.rowwise().minCoeff();
    report.max_corner = mesh.vertices.rowwise().maxCoeff();
    double sum = 0.0;
    for (int e = 0; e < edges.size(); ++e) {
        const double length = (mesh.vertices.col(edges[e].a) - mesh.vertices.col(edges[e].b)).norm();
        sum += length;
        report.shortest_edge = e == 0 ? length : std::min(report.shortest_edge, length);
        report.longest_edge = std::max(report.longest_edge, length);
    }
    report.mean_edge = edges.size() == 0 ? 0.0 : sum / edges.size();
}

Defect no_triangles() {
    Defect defect{};
    defect.kind = Defect::Kind::no_triangles;
    defect.count = 1;
    defect.fatal = true;
    defect.found = "it has no triangle of finite points";
    defect.text = defect.found + ". Choose a file with a surface.";
    return defect;
}

/// Repairs orientation where that is possible and inspects the surface as a whole; needs finite coordinates.
void inspect_as_a_whole(SurfaceMesh& mesh, const EdgeTable& edges, const Components& components, MeshReport& report,
                        const Control& control) {
    repair_orientation(mesh, edges, components, report);
    const CrossingPairs crossings =
        find_crossing_pairs(mesh, any_fatal(report) ? CrossingSearch::briefly : CrossingSearch::all, control);
    report_crossings(mesh, crossings, report);
    if (report.closed && !any_fatal(report)) repair_inside_out(mesh, components, crossings, report);
}

}  // namespace

bool MeshReport::usable() const { return !any_fatal(*this); }

bool MeshReport::usable_for_fem() const {
    return usable() &&
           std::none_of(defects.begin(), defects.end(), [](const Defect& d) { return d.fatal_for_fem && !d.repaired; });
}

CheckedMesh check_and_repair(SurfaceMesh mesh, Control& control) {
    CheckedMesh result{std::move(mesh), {}};
    MeshReport& report = result.report;
    if (result.mesh.n_triangles() == 0) {
        report.defects.push_back(no_triangles());
        return result;
    }
    control.checkpoint();
    report_unreferenced(result.mesh, report);
    leave_out_non_finite(result.mesh, report);
    if (result.mesh.n_triangles() == 0) {
        report.defects.push_back(no_triangles());
        return result;
    }
    if (report_extent(result.mesh, report)) return result;
    report_collapsed(result.mesh, report);

    SurfaceMesh sound = without_collapsed(result.mesh);
    const bool complete = sound.n_triangles() == result.mesh.n_triangles();
    const EdgeTable edges(sound);
    const Components components = connected_components(sound, edges);
    report.n_components = components.count;
    report_edges(sound, edges, report);
    report.closed = complete;
    for (int e = 0; e < edges.size(); ++e) report.closed = report.closed && edges.half_edges(e).size() == 2;
    report_hinges(sound, report);
    report_duplicates(sound, report);
    measure(sound, edges, report);
    report_shapes(sound, report);
    inspect_as_a_whole(sound, edges, components, report, control);
    if (complete) result.mesh = std::move(sound);
    return result;
}

CheckedMesh check_and_repair(SurfaceMesh mesh) {
    Control never_cancelled;
    return check_and_repair(std::move(mesh), never_cancelled);
}

void require_usable(const MeshReport& report, const std::string& name, bool for_fem) {
    std::string findings;
    for (const Defect& defect : report.defects)
        if (defect.fatal || (for_fem && defect.fatal_for_fem && !defect.repaired)) findings += " " + defect.text;
    if (!findings.empty()) throw MeshError(name + ":" + findings);
}

}  // namespace elastolab
