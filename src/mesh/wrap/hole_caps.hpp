#pragma once

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Triangles that close the holes of a surface, for wrapping only: fans around the middle of each rim.
struct HoleCaps {
    SurfaceMesh closed;  ///< the surface with its caps; vertices of caps come last
    int n_holes = 0;     ///< that were capped
};

/// Caps the holes whose cap is at most a tenth of the area of the surface: a larger opening is taken for the shape that
/// is meant (a sheet, a cup). Rims that branch are left open. Vertices are finite.
HoleCaps cap_holes(const SurfaceMesh& surface);

}  // namespace elastolab
