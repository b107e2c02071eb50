#pragma once

#include <string>

#include "deform/method.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// What a precomputation would take. Some milliseconds on fine surfaces; the first call measures the speed of the
/// machine as well, which takes a tenth of a second.
Cost predict_cost(const SurfaceMesh& surface, const Method& method);

/// Predicted seconds for people. They hold within a factor of two, so that two digits are enough.
std::string readable_prediction(double seconds);

/// Throws SolveError, naming both numbers and the next cheaper mode, when `cost` exceeds the memory left.
void require_memory(const Cost& cost, const Method& method);

}  // namespace elastolab
