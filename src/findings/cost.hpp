#pragma once

#include "deform/method.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// What a precomputation would take; microseconds.
Cost predict_cost(const SurfaceMesh& surface, const Method& method);

/// Throws SolveError, naming both numbers and the next cheaper mode, when `cost` exceeds the memory left.
void require_memory(const Cost& cost, const Method& method);

}  // namespace elastolab
