#pragma once

#include <string>

#include "base/control.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// What TetGen makes of a surface.
struct TetgenResult {
    Positions vertices;            ///< the surface's first
    Tetrahedra tetrahedra;         ///< as TetGen orients them
    std::string failure;           ///< empty on success; else what went wrong, e.g. "the surface intersects itself"
    bool ran_out_of_time = false;  ///< a failure that another attempt is likely to share
};

/// What TetGen is to do.
struct TetgenSettings {
    std::string switches;  ///< of its command line
    /// Bound on a tetrahedron's volume, in units of the regular one whose edge length the SizeField of this growth
    /// gives at its middle; <= 0: no bound.
    double relative_volume = 0.0, growth = 0.0;
    bool seeded = false;  ///< begins with points inside, where there is a growth (seed_points.hpp)
};

/// Runs TetGen in a process of its own, for no longer than a hundred times what surfaces of that size take: where one
/// is twisted or folds through itself, TetGen may flip tetrahedra to and fro for ever. `holes`: a point inside each
/// cavity. Throws MeshError only when the helper program is missing or of another version; Cancelled.
TetgenResult run_tetgen(const SurfaceMesh& surface, const Positions& holes, const TetgenSettings& settings,
                        Control& control);

}  // namespace elastolab
