#include <algorithm>
#include <cmath>
#include <cstdint>
#include <Eigen/Geometry>
#include <limits>

#include "base/text.hpp"
#include "mesh/box_tree.hpp"
#include "mesh/checks/defects.hpp"
#include "mesh/checks/triangle_contact.hpp"
#include "mesh/measures.hpp"

namespace elastolab {

using Eigen::Vector3d;

namespace {

/// Altitude / longest edge. Boundary integrals lose (longest edge / altitude)^2 roundings, of extended precision below
/// 0.01 (kSliverAltitude): they are right to 1e-12 at 1e-3 and to 1e-9 at 1e-4.
constexpr double kSliver = 1e-3, kBadSliver = 1e-4, kNoArea = 1e-7;

const char* sliver_advice(double thinnest) {
    return thinnest < kBadSliver
               ? ", below a ten-thousandth, where boundary elements keep fewer than nine "
                 "digits. Remesh the surface there."
               : ", where boundary elements keep nine to twelve digits. Remesh the surface there if the "
                 "result must be more accurate.";
}

}  // namespace

bool report_extent(const SurfaceMesh& mesh, MeshReport& report) {
    Eigen::AlignedBox3d box;
    for (const int v : mesh.triangles.reshaped()) box.extend(Vector3d(mesh.vertices.col(v)));
    const double extent = box.isEmpty() ? 0.0 : box.diagonal().maxCoeff();
    if (!(extent > 0.0 && extent < kLeastExtent)) return false;
    report.min_corner = box.min();
    report.max_corner = box.max();
    Defect defect{};
    defect.kind = Defect::Kind::too_small;
    defect.count = 1;
    defect.fatal = true;
    defect.found = "it is only " + readable_number(extent) + " mesh units across";
    defect.text = defect.found +
                  "; below 1e-70 its areas and volumes are beyond double precision. Choose a smaller unit of length.";
    report.defects.push_back(std::move(defect));
    return true;
}

void report_shapes(const SurfaceMesh& mesh, MeshReport& report) {
    DefectCount flat, slivers;
    double thinnest = 1.0;
    for (int t = 0; t < mesh.n_triangles(); ++t) {
        const TrianglePoints p = triangle_points(mesh, t);
        const double longest = std::max({(p.b - p.a).norm(), (p.c - p.b).norm(), (p.a - p.c).norm()});
        const double ratio = longest > 0.0 ? area_vector(p).norm() / (longest * longest) : 0.0;
        thinnest = std::min(thinnest, ratio);
        const Vector3d center = (p.a + p.b + p.c) / 3.0;
        if (!(ratio > kNoArea)) {
            flat.add(center);
        } else if (ratio < kSliver) {
            slivers.add(center);
        }
    }
    report.smallest_altitude_ratio = thinnest;
    flat.report_fatal(report, Defect::Kind::degenerate_triangles, "triangle has no area", "triangles have no area",
                      ". Remove degenerate triangles or remesh, and reload.");
    if (slivers.count() == 0) return;
    report.defects.push_back(
        slivers.build(Defect::Kind::sliver_triangles, "triangle is thinner than a thousandth of its length",
                      "triangles are thinner than a thousandth of their length", sliver_advice(thinnest)));
}

CrossingPairs find_crossing_pairs(const SurfaceMesh& mesh, CrossingSearch search, const Control& control) {
    constexpr std::size_t kMostPairs = 100000;  // a mesh with more is beyond repair, and could have n^2 of them
    // The exact predicates need numbers far from over- and underflow; scaling by a power of two changes no digit.
    const double size = std::max(mesh.vertices.cwiseAbs().maxCoeff(), 1e-300);
    const SurfaceMesh unit{mesh.vertices * std::ldexp(1.0, -std::ilogb(size)), mesh.triangles};
    const std::vector<char> repeats = repeats_of_triangles(mesh);
    std::vector<int> sound;
    for (int t = 0; t < unit.n_triangles(); ++t) {
        const TrianglePoints p = triangle_points(unit, t);
        if (!repeats[static_cast<std::size_t>(t)] && !is_degenerate(p.a, p.b, p.c)) sound.push_back(t);
    }
    // Triangles of a good surface have some fifteen others near them each.
    const std::int64_t most_tests = search == CrossingSearch::all ? std::numeric_limits<std::int64_t>::max()
                                                                  : 100 * std::int64_t{unit.n_triangles()} + 100000;
    std::int64_t n_tests = 0;
    CrossingPairs found;
    BoxTree(unit, std::move(sound)).for_each_close_pair([&](int s, int t) {
        control.checkpoint();
        if (in_contact(unit, s, t)) found.pairs.emplace_back(s, t);
        return found.pairs.size() < kMostPairs && ++n_tests < most_tests;
    });
    found.complete = found.pairs.size() < kMostPairs && n_tests < most_tests;
    return found;
}

void report_crossings(const SurfaceMesh& mesh, const CrossingPairs& crossings, MeshReport& report) {
    if (crossings.pairs.empty()) return;
    DefectCount found;
    for (const auto& [s, t] : crossings.pairs) {
        const TrianglePoints p = triangle_points(mesh, s);
        found.add((p.a + p.b + p.c) / 3.0);
    }
    Defect defect = found.build(Defect::Kind::self_intersections, "pair of triangles crosses or touches",
                                "pairs of triangles cross or touch",
                                ", so FEM cannot fill it. Remove the overlap, or use a boundary-element method.");
    if (!crossings.complete)
        for (std::string* text : {&defect.found, &defect.text}) *text = "at least " + *text;
    defect.fatal_for_fem = true;
    report.defects.push_back(std::move(defect));
}

}  // namespace elastolab
