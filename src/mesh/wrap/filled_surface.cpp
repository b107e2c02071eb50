#include "mesh/wrap/filled_surface.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "mesh/checks/check.hpp"
#include "mesh/wrap/unit_frame.hpp"
#include "mesh/wrap/wrap_process.hpp"

namespace elastolab {

namespace {

/// What keeps a method from using the surface; empty when nothing does.
std::string first_defect(const MeshReport& report) {
    for (const Defect& defect : report.defects)
        if (!defect.repaired && (defect.fatal || defect.fatal_for_fem))
            return defect.text.substr(0, defect.text.find(". "));  // without its advice
    return "";
}

/// The surface without the vertices that no triangle uses.
SurfaceMesh without_unused(const SurfaceMesh& open, std::vector<int>& own) {
    own.assign(static_cast<std::size_t>(open.n_vertices()), -1);
    for (const int v : open.triangles.reshaped()) own[static_cast<std::size_t>(v)] = 0;
    std::vector<int> used;
    for (int v = 0; v < open.n_vertices(); ++v)
        if (int& number = own[static_cast<std::size_t>(v)]; number == 0) {
            number = static_cast<int>(used.size());
            used.push_back(v);
        }
    SurfaceMesh mesh{open.vertices(Eigen::all, used), open.triangles};
    for (int& v : mesh.triangles.reshaped()) v = own[static_cast<std::size_t>(v)];
    return mesh;
}

/// The vertices of `open` in their own places, whatever the frame made of them.
SurfaceMesh in_place(SurfaceMesh filled, const SurfaceMesh& open, const UnitFrame& frame) {
    filled.vertices = (filled.vertices * frame.scale).colwise() + frame.centre;
    filled.vertices.leftCols(open.n_vertices()) = open.vertices;
    return filled;
}

}  // namespace

FilledSurface fill_holes(const SurfaceMesh& shown, Control& control) {
    control.begin_stage("fill holes");
    std::vector<int> own;
    const SurfaceMesh open = without_unused(shown, own);
    SurfaceMesh unit = open;
    const UnitFrame frame = to_unit_size(unit);
    std::string failure;
    for (const HoleFilling how : {HoleFilling::smooth, HoleFilling::flat}) {
        WrapResult result = fill_holes(unit, how, control);
        if (!result.failure.empty()) {
            failure = result.failure;
            continue;
        }
        const int n_vertices = result.surface.n_vertices();
        CheckedMesh checked = check_and_repair(in_place(std::move(result.surface), open, frame), control);
        failure = first_defect(checked.report);
        if (failure.empty() && checked.mesh.n_vertices() == n_vertices)
            return {std::move(checked.mesh), std::move(own), result.n_holes};
    }
    throw MeshError("even with its holes filled it is not a solid: " + failure + ". Choose a proxy.");
}

}  // namespace elastolab
