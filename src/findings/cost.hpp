#pragma once

#include <string>
#include <vector>

#include "deform/method.hpp"
#include "mesh/solids.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// What a precomputation would take, of all solids together: each has a system of its own. The larger the surface the
/// longer it takes itself, up to a tenth of a second at 40 000 vertices. Whoever asks for seconds first measures the
/// speed of the machine (deform/machine_speed.hpp).
Cost predict_cost(const SurfaceMesh& surface, const Method& method);
Cost predict_cost(const std::vector<Solid>& solids, const Method& method);

/// Predicted seconds for people. They hold within a factor of two, so that two digits are enough.
std::string readable_prediction(double seconds);

/// Throws SolveError, naming both numbers and the next cheaper mode, when `cost` exceeds the memory left.
void require_memory(const Cost& cost, const Method& method);

}  // namespace elastolab
