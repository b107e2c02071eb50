#pragma once

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// What an open surface is taken for: that of a solid, whose holes are closed, or a sheet, which becomes a thin wall.
enum class OpenSurface {
    automatic,  ///< a solid when its holes are small beside it
    solid,
    sheet
};

/// Triangles that close the holes of a surface: fans around the middle of each rim.
struct HoleCaps {
    SurfaceMesh closed;   ///< the surface with its caps; vertices of caps come last
    int n_holes = 0;      ///< that were capped
    int n_left_open = 0;  ///< that were not, since their part of the surface is taken for a sheet
};

/// Caps the holes of a surface. Parts of it that have a rim in common are judged as one: automatic, all their holes are
/// capped when the caps have at most kLargestOpening of the part's area together, and none otherwise. A ball of which a
/// fraction f of the surface is missing has caps of f times the rest: a tenth missing is a solid, half a ball is not,
/// nor is a mask, a plane sheet or a tube shorter than twice its width. Rims that pass a vertex several times are cut
/// there. Vertices are finite.
HoleCaps cap_holes(const SurfaceMesh& surface, OpenSurface taken_for = OpenSurface::automatic);

inline constexpr double kLargestOpening = 0.25;

}  // namespace elastolab
