#include "mesh/wrap/filled_surface.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "mesh/checks/check.hpp"
#include "mesh/numbering.hpp"
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

/// Where the vertices of `shown` are among those that triangles use; -1 for the others.
std::vector<int> places_of_used(const SurfaceMesh& shown) {
    std::vector<int> own(static_cast<std::size_t>(shown.n_vertices()), -1);
    int n = 0;
    for (const int v : used_vertices(shown.triangles)) own[static_cast<std::size_t>(v)] = n++;
    return own;
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
    const SurfaceMesh open = without_unused(shown);
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
            return {std::move(checked.mesh), places_of_used(shown), result.n_holes};
    }
    throw MeshError("even with its holes filled it is not a solid: " + failure + ". Choose a proxy.");
}

}  // namespace elastolab
