#pragma once

#include <string>

#include "base/control.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// What TetGen makes of a surface.
struct TetgenResult {
    Positions vertices;     ///< the surface's first
    Tetrahedra tetrahedra;  ///< as TetGen orients them
    std::string failure;    ///< empty on success; else what went wrong, e.g. "the surface intersects itself"
};

/// Runs TetGen with these command-line switches in a process of its own. `holes`: a point inside each cavity.
/// Throws MeshError only when the helper program is missing or of another version; Cancelled.
TetgenResult run_tetgen(const SurfaceMesh& surface, const Positions& holes, const std::string& switches,
                        Control& control);

}  // namespace elastolab
