#pragma once

#include <vector>

#include "base/control.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// A surface whose holes have been filled.
struct FilledSurface {
    SurfaceMesh
        surface;  ///< those of the open one come first: its used vertices, its triangles (but for their orientation)
    std::vector<int> own;  ///< for each vertex of the open one its number here; -1: no triangle uses it
    int n_holes = 0;
};

/// Fills every hole of an open surface, smoothly where that keeps it sound (CGAL, in the process of the wrap), so that
/// every method can simulate it with all its own vertices. Throws MeshError when the surface is no solid even then (it
/// says why); Cancelled.
FilledSurface fill_holes(const SurfaceMesh& shown, Control& control);

}  // namespace elastolab
