#pragma once

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Integrals, of which integral_speed() take a second, of the pairs of triangles that nearly touch without a common
/// corner, as on both sides of a thin plate, and of slivers with what is around them, whose closed forms take extended
/// precision: from the quadrature points of a few of them and the number around some triangles. Zero for bodies without
/// such walls and slivers. Milliseconds.
double costly_pair_integrals(const SurfaceMesh& surface);

}  // namespace elastolab
