#pragma once

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Delaunay triangulation of points on the unit sphere: the faces of their convex hull, outward. Points in general
/// position, the origin inside their hull.
Triangles triangulate_sphere(const Positions& directions);

/// Flips edges while that raises the smallest angles of the triangles over `places`, and the triangulation of the
/// directions stays valid: for a surface that is star-shaped about the origin but far from a sphere.
void flip_to_delaunay(Triangles& triangles, const Positions& directions, const Positions& places);

}  // namespace elastolab
