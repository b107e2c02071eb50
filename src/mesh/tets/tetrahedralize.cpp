#include "mesh/tets/tetrahedralize.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <numbers>
#include <vector>

#include "base/error.hpp"
#include "base/text.hpp"
#include "mesh/checks/cavity_point.hpp"
#include "mesh/checks/defects.hpp"
#include "mesh/measures.hpp"
#include "mesh/tets/boundary.hpp"
#include "mesh/tets/canonical_frame.hpp"
#include "mesh/tets/tet_quality.hpp"
#include "mesh/tets/tetgen_process.hpp"
#include "mesh/topology.hpp"

namespace elastolab {

using Eigen::Vector3d;

namespace {

/// One point in each cavity.
Positions cavity_points(const SurfaceMesh& mesh) {
    std::vector<Vector3d> points;
    for (const auto& triangles : connected_components(mesh, EdgeTable(mesh)).triangles())
        if (enclosed_volume(mesh, triangles) < 0.0) points.push_back(point_in_cavity(mesh, triangles));
    Positions result(3, static_cast<Eigen::Index>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i) result.col(static_cast<Eigen::Index>(i)) = points[i];
    return result;
}

/// p: a surface; Y: keep it as it is, no vertex added on it; q: bounds on radius over edge and on the dihedral angles;
/// O, o: improve until angles are below 145 degrees (least angle measured on primitives: 15 to 17 degrees, 6 to 9
/// without); T: tolerance for coplanar; a: volume bound.
TetgenSettings settings(const TetOptions& options, const SurfaceMesh& solid, double tolerance) {
    TetgenSettings settings;
    settings.switches = formatted("pYzq%.6g/12O9/7o/145T%.3g", options.radius_edge_ratio, tolerance);
    if (options.relative_volume <= 0.0) return settings;
    settings.growth = options.growth.value_or(default_growth(solid.n_vertices()));
    if (settings.growth > 0.0) {
        settings.relative_volume = options.relative_volume;
    } else {
        const double edge = mean_edge(solid), regular_volume = edge * edge * edge / (6.0 * std::numbers::sqrt2);
        settings.switches += formatted("a%.15f", options.relative_volume * regular_volume);
    }
    return settings;
}

/// det > 0 for every tetrahedron; TetGen's convention is the other one.
void orient(TetMesh& mesh) {
    for (int t = 0; t < mesh.n_tetrahedra(); ++t)
        if (tet_volume(mesh, t) < 0.0) std::swap(mesh.tetrahedra(0, t), mesh.tetrahedra(1, t));
}

/// What is wrong with TetGen's answer; empty if it fills exactly this surface with proper tetrahedra.
std::string flaw(const TetMesh& mesh, const SurfaceMesh& solid) {
    if (mesh.n_tetrahedra() == 0) return "TetGen found nothing inside it";
    // Below this shape an element is flat to rounding and its stiffness is noise.
    constexpr double kFlat = 1e-13;
    if (tet_quality(mesh).least_shape <= kFlat) return "TetGen could only fill it with tetrahedra that have no volume";
    const Triangles boundary = boundary_triangles(mesh);
    if (boundary.cols() != solid.triangles.cols() || boundary != canonical(solid.triangles))
        return "TetGen could not keep its surface as it is";
    return "";
}

/// Why TetGen is not even called: on such input it crashes, or never ends.
std::string obstacle(const SurfaceMesh& solid) {
    if (solid.n_triangles() == 0) return "it has no triangle";
    if (!solid.vertices.allFinite()) return "it has vertices that are not finite";
    const EdgeTable edges(solid);
    for (int e = 0; e < edges.size(); ++e)
        if (edges.half_edges(e).size() != 2) return "its surface is not closed";
    if (!(enclosed_volume(solid) > 0.0)) return "it encloses no volume";
    return "";
}

std::string message(const std::string& name, const std::string& finding) {
    return name + ": it cannot be filled with tetrahedra for FEM: " + finding +
           ". Repair or remesh the surface, or choose a boundary-element method.";
}

/// Why TetGen has failed: a crossing found by our own search says more than TetGen, which tends to crash then. Where it
/// is, the checks of the mesh tell; here the solid may be in coordinates of its own.
std::string reason(const SurfaceMesh& solid, const std::string& finding, const Control& control) {
    const CrossingPairs crossings = find_crossing_pairs(solid, CrossingSearch::all, control);
    if (crossings.pairs.empty()) return finding;
    return "its surface intersects itself, " +
           counted(static_cast<int>(crossings.pairs.size()), "pair of triangles", "pairs of triangles", {});
}

TetMesh to_mesh(const TetgenResult& result, const SurfaceMesh& solid, const CanonicalFrame& frame) {
    const int n = solid.n_vertices();
    if (result.vertices.cols() < n) return {};
    TetMesh mesh{frame.to_solid(result.vertices), result.tetrahedra, n};
    mesh.vertices.leftCols(n) = solid.vertices;  // bit by bit
    for (int& v : mesh.tetrahedra.reshaped())
        if (v < n) v = frame.vertices()[static_cast<std::size_t>(v)];
    orient(mesh);
    return mesh;
}

}  // namespace

double default_growth(int n_vertices) { return 0.35 * std::log(std::max(n_vertices, 1000) / 1000.0) / std::log(40.0); }

TetMesh tetrahedralize(const SurfaceMesh& solid, const std::string& name, const TetOptions& options, Control& control) {
    std::string finding = obstacle(solid);
    if (!finding.empty()) throw MeshError(message(name, finding));
    // TetGen's tolerances are absolute in places, so it sees every body in the unit box, and as the same whatever its
    // numbering and orientation. The second attempt is for fine detail that the first tolerance, TetGen's own, takes
    // for coincidence; it begins with the surface alone.
    struct Attempt {
        double tolerance;
        int grid_bits;
        bool seeded;
    };
    for (const auto& [tolerance, grid_bits, seeded] : {Attempt{1e-8, 40, true}, Attempt{1e-13, 52, false}}) {
        const CanonicalFrame frame(solid, grid_bits);
        const SurfaceMesh& unit = frame.mesh();
        TetgenSettings its_settings = settings(options, unit, tolerance);
        its_settings.seeded = seeded;
        TetgenResult result = run_tetgen(unit, cavity_points(unit), its_settings, control);
        if (result.failure.empty()) {
            TetMesh mesh = to_mesh(result, solid, frame);
            result.failure = flaw(mesh, solid);
            if (result.failure.empty()) return mesh;
        }
        if (finding.empty()) finding = result.failure;
        if (result.ran_out_of_time) break;
    }
    control.checkpoint();
    throw MeshError(message(name, reason(solid, finding, control)));
}

}  // namespace elastolab
