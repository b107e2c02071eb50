#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <set>

#include "mesh/checks/defects.hpp"
#include "mesh/checks/nesting.hpp"
#include "mesh/measures.hpp"

namespace elastolab {

using Eigen::Vector3d;

namespace {

void turn(SurfaceMesh& mesh, int t) { std::swap(mesh.triangles(1, t), mesh.triangles(2, t)); }

/// For each half-edge the only other one along its edge, or -1.
std::vector<int> opposite_half_edges(const SurfaceMesh& mesh, const EdgeTable& edges) {
    std::vector<int> opposite(static_cast<std::size_t>(mesh.triangles.size()), -1);
    for (int e = 0; e < edges.size(); ++e) {
        const auto uses = edges.half_edges(e);
        if (uses.size() != 2) continue;
        opposite[static_cast<std::size_t>(uses[0])] = uses[1];
        opposite[static_cast<std::size_t>(uses[1])] = uses[0];
    }
    return opposite;
}

bool same_direction(const SurfaceMesh& mesh, int h, int g) {
    return mesh.triangles(h % 3, h / 3) == mesh.triangles(g % 3, g / 3);
}

struct Turning {
    std::vector<signed char> turned;  ///< per triangle: 1 to be turned, 0 not
    DefectCount conflicts;            ///< edges at which no choice is consistent
};

Turning propagate(const SurfaceMesh& mesh, const EdgeTable& edges) {
    const std::vector<int> opposite = opposite_half_edges(mesh, edges);
    Turning result{std::vector<signed char>(static_cast<std::size_t>(mesh.n_triangles()), -1), {}};
    const auto turned = [&](int t) -> signed char& { return result.turned[static_cast<std::size_t>(t)]; };
    std::vector<int> queue;
    for (int seed = 0; seed < mesh.n_triangles(); ++seed) {
        if (turned(seed) >= 0) continue;
        turned(seed) = 0;
        queue.assign(1, seed);
        while (!queue.empty()) {
            const int t = queue.back();
            queue.pop_back();
            for (int h = 3 * t; h < 3 * t + 3; ++h) {
                const int g = opposite[static_cast<std::size_t>(h)];
                if (g < 0) continue;
                const auto wanted = static_cast<signed char>(turned(t) ^ (same_direction(mesh, h, g) ? 1 : 0));
                if (turned(g / 3) < 0) {
                    turned(g / 3) = wanted;
                    queue.push_back(g / 3);
                } else if (turned(g / 3) != wanted && h < g) {
                    result.conflicts.add(mesh.vertices.col(mesh.triangles(h % 3, t)));
                }
            }
        }
    }
    return result;
}

/// In each component, the smaller part is the one that is wrong.
void keep_majority(Turning& turning, const Components& components) {
    for (const auto& triangles : components.triangles()) {
        const auto turned = [&](int t) -> signed char& { return turning.turned[static_cast<std::size_t>(t)]; };
        const auto n_turned = std::count_if(triangles.begin(), triangles.end(), [&](int t) { return turned(t) == 1; });
        if (2 * n_turned > std::ssize(triangles))
            for (const int t : triangles) turned(t) ^= 1;
    }
}

}  // namespace

void repair_orientation(SurfaceMesh& mesh, const EdgeTable& edges, const Components& components, MeshReport& report) {
    Turning turning = propagate(mesh, edges);
    turning.conflicts.report_fatal(report, Defect::Kind::inconsistent_orientation, "edge shows that it is one-sided",
                                   "edges show that it is one-sided",
                                   " (like a Moebius strip), so it has no inside. Rebuild the surface.");
    if (turning.conflicts.count() > 0) return;
    keep_majority(turning, components);
    DefectCount found;
    for (int t = 0; t < mesh.n_triangles(); ++t)
        if (turning.turned[static_cast<std::size_t>(t)] == 1) {
            turn(mesh, t);
            found.add(centroid(mesh, t));
        }
    if (found.count() == 0) return;
    report.defects.push_back(found.build(Defect::Kind::inconsistent_orientation,
                                         "triangle faced the other way than its neighbours",
                                         "triangles faced the other way than their neighbours", "; flipped."));
    report.defects.back().repaired = true;
}

void repair_inside_out(SurfaceMesh& mesh, const Components& components, const CrossingPairs& crossings,
                       MeshReport& report) {
    std::set<std::pair<int, int>> crossing;
    for (const auto& [s, t] : crossings.pairs) {
        const auto [low, high] = std::minmax(
            {components.of_triangle[static_cast<std::size_t>(s)], components.of_triangle[static_cast<std::size_t>(t)]});
        crossing.emplace(low, high);
    }
    const auto apart = [&](int c, int d) { return crossing.contains({std::min(c, d), std::max(c, d)}); };
    const auto parts = components.triangles();
    const auto around = surfaces_around(mesh, parts, apart);
    DefectCount inside_out, flat;
    for (std::size_t c = 0; c < parts.size(); ++c) {
        constexpr double kNoVolume = 1e-12;  // of the bounding cube: rounding, not a thin plate
        const double volume = enclosed_volume(mesh, parts[c]);
        const double diagonal = bounding_box(mesh, parts[c]).diagonal().norm();
        const bool solid = around[c].size() % 2 == 0;
        report.n_solids += solid;
        report.volume += solid ? std::abs(volume) : -std::abs(volume);
        if (std::abs(volume) <= kNoVolume * diagonal * diagonal * diagonal) {
            flat.add(centroid(mesh, parts[c].front()));
        } else if ((volume > 0.0) != solid) {
            for (const int t : parts[c]) turn(mesh, t);
            inside_out.add(centroid(mesh, parts[c].front()));
        }
    }
    flat.report_fatal(report, Defect::Kind::zero_volume, "part encloses no volume", "parts enclose no volume",
                      ". Give them a thickness or remove them.");
    if (inside_out.count() == 0) return;
    report.defects.push_back(inside_out.build(Defect::Kind::inside_out, "closed surface was inside out",
                                              "closed surfaces were inside out", "; flipped."));
    report.defects.back().repaired = true;
}

}  // namespace elastolab
