#pragma once

#include <span>
#include <vector>

#include "base/control.hpp"
#include "mesh/checks/check.hpp"
#include "mesh/surface_mesh.hpp"
#include "mesh/wrap/hole_caps.hpp"

namespace elastolab {

/// A closed surface that is simulated in place of one that is too large, or that bounds no solid.
struct ProxySurface {
    enum class Kind {
        wrapped,
        collapsed,
        filled
    };                    ///< filled: the surface itself, its holes filled (filled_surface.hpp)
    SurfaceMesh surface;  ///< closed, oriented, 2-manifold, without self-intersections: usable by every method
    Kind kind = Kind::wrapped;
    int n_capped_holes = 0;
    int n_open_holes = 0;    ///< left open, because their part of the surface was taken for a sheet (hole_caps.hpp)
    double thin_part = 0.0;  ///< fraction of its vertices on walls as thin as the wrap can make them: open sheets
    double thickness = 0.0;  ///< of such a wall [L]
};

/// Makes proxies of any triangles, one of about each of these numbers of vertices. Holes of what is taken for a solid
/// are closed. A surface that every method can use then has its edges collapsed, or is taken as it is when it has no
/// more vertices than are wanted; everything else is wrapped, the vertices of the wrap are moved back onto the surface
/// where that keeps it sound, and its edges are collapsed. What TetGen cannot fill is made again, rougher or finer.
/// Vertices that are not finite, and their triangles, do not count. Takes one to three seconds for 100 000 triangles,
/// some seconds for hundreds of triangles that cross each other. Throws MeshError when there are no three vertices off
/// a line, or when it cannot be done; Cancelled.
std::vector<ProxySurface> make_proxy_surfaces(const SurfaceMesh& shown, const MeshReport& report,
                                              std::span<const int> sizes, Control& control,
                                              OpenSurface taken_for = OpenSurface::automatic);

}  // namespace elastolab
