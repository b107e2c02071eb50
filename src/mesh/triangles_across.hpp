#pragma once

#include "mesh/measures.hpp"

namespace elastolab {

/// Triangles across a body: its thickness, that of a square bar of so much volume and surface, over the mean edge.
inline double triangles_across(const SurfaceMesh& surface) {
    return 4.0 * enclosed_volume(surface) / (surface_area(surface) * mean_edge(surface));
}

/// With fewer than these, boundary elements are too stiff in bending all over, and not at rims alone: Galerkin BEM on
/// bars of 1, 2 and 3 cells across by 26, 4 and 1.2 %.
inline constexpr double kFewTrianglesAcross = 2.6;

}  // namespace elastolab
