#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <span>
#include <vector>

#include "deform/constraint_map.hpp"
#include "deform/load_share.hpp"
#include "deform/unit_load.hpp"
#include "mesh/refine.hpp"

namespace elastolab {

/// A constrained set on the surface where its equations are made: that of the body, or one with finer rims.
struct SurfaceSet {
    std::vector<int> vertices;  ///< constrained ones of that surface
    std::vector<UnitLoad> loads;
    ConstrainedNodes nodes;         ///< how the body's constrained vertices act on them
    std::vector<LoadShare> shares;  ///< which of the body's carries which reaction

    /// On the body's own surface.
    SurfaceSet(const SurfaceMesh& surface, std::vector<int> vertices, std::span<const UnitLoad> loads);

protected:
    SurfaceSet() = default;
};

/// What happens around a constrained vertex without a constrained triangle. Its answer is that of a force spread over
/// the triangles around it, and has no limit as they become smaller.
enum class LoneVertices { kept, refined };

/// Which of the body's triangles are halved (into four) before rows are added along the rims. Slivers never are.
enum class Halved { none, all };

/// The same set on a surface with rows of thin triangles along the rims of the constrained patches
/// (add_rows_along_rim), where tractions are singular, and along re-entrant edges of the body, where stresses are
/// singular too, unless nearly every edge is one (docs/formulation.md section 7). The polyhedron is the same; the
/// body's vertices come first. What is prescribed is linear on each of the body's triangles. What would become a sliver
/// (kSliverAltitudeOfPotential) is cut by its neighbours' new vertices only.
struct FinerRims : SurfaceSet {
    RefinedSurface surface;
    std::int64_t n_constrained_triangles = 0;
    std::int64_t n_constrained_of_body = 0;  ///< triangles of the body that these are parts of
    bool is_finer = false;  ///< false where there is no rim, nor re-entrant edge, or only slivers are there

    /// rows: along the rims, on each side
    FinerRims(const SurfaceMesh& body, std::span<const int> vertices, std::span<const UnitLoad> loads, int rows,
              LoneVertices lone, Halved halved_triangles = Halved::none);
};

}  // namespace elastolab
