#pragma once

#include <optional>
#include <string>

#include "base/control.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Quality of the tetrahedra that TetGen makes.
struct TetOptions {
    double radius_edge_ratio = 1.4;  ///< bound on circumradius / shortest edge
    /// Bound on a tetrahedron's volume, in units of that of the regular tetrahedron over the edge length wanted at its
    /// middle. <= 0: no bound.
    /// Measured without growth: cubes of 4, 8, 13 and 20 cells get 49, 644, 3221, 12763 interior vertices at 1.0; 25,
    /// 347, 1735, 6940 at 1.8; 27, 309, 1500, 6176 at 2.0. The uniform grid of these cells has 27, 343, 1728, 6859: so
    /// 1.8 is the size of the surface.
    double relative_volume = 1.8;
    /// By how much the wanted edge length grows per distance from the surface (mesh/tets/size_field.hpp); 0: it is the
    /// mean edge of the surface everywhere. None: as the number of vertices says (default_growth).
    std::optional<double> growth = {};
};

/// Growth for a surface of so many vertices: none up to 1000, which are cheap, then with the logarithm, 0.35 at 40 000,
/// where uniform tetrahedra would be four times as many. docs/formulation.md section 10 has the measurements.
double default_growth(int n_vertices);

/// Fills one solid (an outer surface and its cavities) with tetrahedra. The surface's vertices and triangles are kept
/// as they are; no vertex is added on the surface. The tetrahedra do not depend on the numbering, nor on mirrors, turns
/// by right angles, size or place but for what rounding moves (CanonicalFrame). TetGen runs in a process of its own, so
/// that an abort or crash of it (self-intersecting input) is an error here and nothing worse. Throws MeshError, naming
/// `name`, when TetGen finds the surface unusable, crashes, runs out of memory or comes to no end; Cancelled.
TetMesh tetrahedralize(const SurfaceMesh& solid, const std::string& name, const TetOptions& options, Control& control);

}  // namespace elastolab
