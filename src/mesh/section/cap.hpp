#pragma once

#include "mesh/section/opened_surface.hpp"

namespace elastolab {

/// The plane part of an opened body's surface.
struct Cap {
    Anchors rim;          ///< its vertices on the surface
    Positions inside;     ///< its other vertices, which come after those
    Triangles triangles;  ///< counter-clockwise seen against the plane's normal
};

/// Fills the outline of an opened surface: what is inside it by the parity of crossings, holes and pieces included.
/// Triangles are Delaunay; `edge` [L] is about the length wanted of their edges. At least kEdgesAcrossCap edges go into
/// the width of the cap, and max_inside points at most (one at least) lie inside. A surface that is not closed gets
/// some cap or none.
inline constexpr double kEdgesAcrossCap = 16.0;
Cap make_cap(const SurfaceMesh& surface, const OpenedSurface& opened, const Plane& plane, double edge,
             int max_inside = 3000);

}  // namespace elastolab
