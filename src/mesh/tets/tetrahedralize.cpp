#include "mesh/tets/tetrahedralize.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Geometry>
#include <numbers>
#include <vector>

#include "base/error.hpp"
#include "base/text.hpp"
#include "mesh/checks/cavity_point.hpp"
#include "mesh/checks/defects.hpp"
#include "mesh/measures.hpp"
#include "mesh/tets/tet_quality.hpp"
#include "mesh/tets/tetgen_process.hpp"
#include "mesh/topology.hpp"

namespace elastolab {

using Eigen::Vector3d;

namespace {

/// TetGen's tolerances are absolute in places, so it sees every body in the unit box. The factor is a power of two:
/// scaling alone changes no digit.
struct UnitBox {
    Vector3d corner;
    double scale;

    explicit UnitBox(const Positions& vertices) : corner(vertices.rowwise().minCoeff()) {
        const double extent = (vertices.rowwise().maxCoeff() - corner).maxCoeff();
        scale = std::ldexp(1.0, -std::ilogb(extent) - 1);
    }
    Positions to_unit(const Positions& p) const { return scale * (p.colwise() - corner); }
    Positions from_unit(const Positions& p) const { return (p / scale).colwise() + corner; }
};

double mean_edge(const SurfaceMesh& mesh) {
    const EdgeTable edges(mesh);
    double sum = 0.0;
    for (int e = 0; e < edges.size(); ++e)
        sum += (mesh.vertices.col(edges[e].a) - mesh.vertices.col(edges[e].b)).norm();
    return sum / edges.size();
}

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
std::string switches(const TetOptions& options, double edge, double tolerance) {
    const double regular_volume = edge * edge * edge / (6.0 * std::numbers::sqrt2);
    const std::string text = formatted("pYzq%.6g/12O9/7o/145T%.3g", options.radius_edge_ratio, tolerance);
    return options.relative_volume > 0.0 ? text + formatted("a%.12f", options.relative_volume * regular_volume) : text;
}

/// det > 0 for every tetrahedron; TetGen's convention is the other one.
void orient(TetMesh& mesh) {
    for (int t = 0; t < mesh.n_tetrahedra(); ++t)
        if (tet_volume(mesh, t) < 0.0) std::swap(mesh.tetrahedra(0, t), mesh.tetrahedra(1, t));
}

using Face = std::array<int, 3>;

/// The same cycle of vertices, beginning with the smallest.
Face canonical(int a, int b, int c) {
    Face face{a, b, c};
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    return face;
}

/// Outward faces of the tetrahedra that no other tetrahedron shares, sorted.
std::vector<Face> boundary_faces(const TetMesh& mesh) {
    constexpr int kFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
    std::vector<std::pair<Face, Face>> faces;  // sorted vertices, and the face as it is
    for (int t = 0; t < mesh.n_tetrahedra(); ++t)
        for (const auto& f : kFaces) {
            const Face face = canonical(mesh.tetrahedra(f[0], t), mesh.tetrahedra(f[1], t), mesh.tetrahedra(f[2], t));
            Face key = face;
            std::sort(key.begin(), key.end());
            faces.emplace_back(key, face);
        }
    std::sort(faces.begin(), faces.end());
    std::vector<Face> boundary;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const bool shared = (i > 0 && faces[i - 1].first == faces[i].first) ||
                            (i + 1 < faces.size() && faces[i + 1].first == faces[i].first);
        if (!shared) boundary.push_back(faces[i].second);
    }
    std::sort(boundary.begin(), boundary.end());
    return boundary;
}

std::vector<Face> surface_faces(const SurfaceMesh& mesh) {
    std::vector<Face> faces;
    for (int t = 0; t < mesh.n_triangles(); ++t)
        faces.push_back(canonical(mesh.triangles(0, t), mesh.triangles(1, t), mesh.triangles(2, t)));
    std::sort(faces.begin(), faces.end());
    return faces;
}

/// What is wrong with TetGen's answer; empty if it fills exactly this surface with proper tetrahedra.
std::string flaw(const TetMesh& mesh, const SurfaceMesh& solid) {
    if (mesh.n_tetrahedra() == 0) return "TetGen found nothing inside it";
    // Below this shape an element is flat to rounding and its stiffness is noise.
    constexpr double kFlat = 1e-13;
    if (tet_quality(mesh).least_shape <= kFlat) return "TetGen could only fill it with tetrahedra that have no volume";
    if (boundary_faces(mesh) != surface_faces(solid)) return "TetGen could not keep its surface as it is";
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

/// Why TetGen has failed: a crossing found by our own search says more than TetGen, which tends to crash then.
std::string reason(const SurfaceMesh& solid, const std::string& finding) {
    const CrossingPairs crossings = find_crossing_pairs(solid);
    if (crossings.pairs.empty()) return finding;
    const TrianglePoints p = triangle_points(solid, crossings.pairs.front().first);
    return "its surface intersects itself, " + counted(static_cast<int>(crossings.pairs.size()), "pair of triangles",
                                                       "pairs of triangles", {(p.a + p.b + p.c) / 3.0});
}

TetMesh to_mesh(TetgenResult&& result, const SurfaceMesh& solid, const UnitBox& box) {
    TetMesh mesh{box.from_unit(result.vertices), std::move(result.tetrahedra), solid.n_vertices()};
    if (mesh.n_vertices() < mesh.n_surface_vertices) return {};
    mesh.vertices.leftCols(solid.n_vertices()) = solid.vertices;  // bit by bit
    orient(mesh);
    return mesh;
}

}  // namespace

TetMesh tetrahedralize(const SurfaceMesh& solid, const std::string& name, const TetOptions& options, Control& control) {
    std::string finding = obstacle(solid);
    if (!finding.empty()) throw MeshError(message(name, finding));
    const UnitBox box(solid.vertices);
    const SurfaceMesh unit{box.to_unit(solid.vertices), solid.triangles};
    const Positions holes = cavity_points(unit);
    // The second tolerance is for fine detail that TetGen's default, the first, takes for coincident.
    for (const double tolerance : {1e-8, 1e-13}) {
        TetgenResult result = run_tetgen(unit, holes, switches(options, mean_edge(unit), tolerance), control);
        if (result.failure.empty()) {
            TetMesh mesh = to_mesh(std::move(result), solid, box);
            result.failure = flaw(mesh, solid);
            if (result.failure.empty()) return mesh;
        }
        if (finding.empty()) finding = result.failure;
    }
    control.checkpoint();
    throw MeshError(message(name, reason(solid, finding)));
}

}  // namespace elastolab
