#pragma once

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Of a square bar of so much volume and surface, 4V/A [L]: its width if it is long; of a plate twice its thickness.
double thickness(const SurfaceMesh& surface);

/// Triangles across a body: its thickness over the mean edge. With
/// several closed surfaces that, or the fewest of one of them: a cavity counts like a body of its shape.
double triangles_across(const SurfaceMesh& surface);

/// With fewer than these, boundary elements are too stiff in bending all over, and not at rims alone: Galerkin BEM on
/// bars of 1, 2 and 3 cells across by 26, 4 and 1.2 %. A cavity of 12 vertices under pressure is 80 % off.
inline constexpr double kFewTrianglesAcross = 2.6;

}  // namespace elastolab
