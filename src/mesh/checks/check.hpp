#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/control.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// One kind of defect: how many, and where the first few are.
struct Defect {
    // clang-format off
    enum class Kind {
        no_triangles, non_finite, open_edges, non_manifold_edges, non_manifold_vertices, inconsistent_orientation,
        inside_out, degenerate_triangles, sliver_triangles, duplicate_triangles, unreferenced_vertices,
        self_intersections, zero_volume, coarse_coordinates, too_small
    };
    // clang-format on
    Kind kind;
    int count = 0;
    std::vector<Eigen::Vector3d> places;  ///< of the first few, at most 8
    bool repaired = false;
    bool fatal = false;  ///< the body cannot be used by any method
    bool fatal_for_fem = false;
    std::string found;  ///< "12 open edges near (0, 1, 0)"
    std::string text;   ///< what it means and what helps, too: "12 open edges near (0, 1, 0), so it bounds no solid.
                        ///< Fill the holes and reload."
};

/// Facts about a mesh, and its defects.
struct MeshReport {
    std::vector<Defect> defects;
    int n_components = 0;  ///< connected surfaces
    int n_solids = 0;
    bool closed = false;
    double volume = 0.0;  ///< [L^3]
    double area = 0.0;    ///< [L^2]
    Eigen::Vector3d min_corner = Eigen::Vector3d::Zero(), max_corner = Eigen::Vector3d::Zero();
    double shortest_edge = 0.0, mean_edge = 0.0, longest_edge = 0.0;  ///< [L]
    double smallest_altitude_ratio = 0.0;  ///< least altitude / longest edge over all triangles

    bool usable() const;          ///< no fatal defect is left
    bool usable_for_fem() const;  ///< nor one that is fatal for FEM
};

/// A mesh whose inconsistent or inside-out parts were turned round, and the report on it, repairs included.
struct CheckedMesh {
    SurfaceMesh mesh;
    MeshReport report;
};

/// Inspects and repairs. Vertex numbers never change. Never throws on bad geometry: it reports.
/// - fatal: no triangle, coordinates that are not finite or beyond 1e70 (the mesh is returned without their triangles),
///   a mesh less than 1e-70 across (nothing else is looked at then: squares of areas would underflow), open edges,
///   edges of more than two triangles, vertices where parts of the surface only touch (a hinge), triangles without
///   area, the same triangle twice, a one-sided surface, parts that enclose no volume, and vertices of no triangle
///   (load_surface drops those).
/// - fatal for FEM, a warning for the others: parts of the surface that cross or touch. Found exactly.
/// - repaired: triangles that face the other way than their neighbours, and closed surfaces that face the wrong way:
///   outward at even depth of nesting (solids), inward at odd depth (cavities).
/// - warning: triangles of altitude below 1e-3 of the longest edge. Coordinates that were rounded when they were read
///   (coarse_coordinates) are reported by the reader (mesh/input/import.hpp).
/// The search for crossing triangles, which takes most of the time, can be cancelled: then throws Cancelled.
CheckedMesh check_and_repair(SurfaceMesh mesh, Control& control);
/// The same for callers that never cancel.
CheckedMesh check_and_repair(SurfaceMesh mesh);

/// Throws MeshError with `name`, every fatal finding and a way forward in one line, when the report is not usable
/// (or, if `for_fem`, not usable for FEM).
void require_usable(const MeshReport& report, const std::string& name, bool for_fem);

}  // namespace elastolab
