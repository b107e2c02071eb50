#pragma once

#include <cstdint>

#include "deform/deformer.hpp"
#include "deform/method.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// What a precomputation would take; microseconds.
Cost predict_cost(const SurfaceMesh& surface, const Method& method);

/// Bytes that the estimates of the error of an answer take while they are made (Deformer::discretisation_check), beyond
/// what is held for the constrained set. Milliseconds.
std::uint64_t predict_check_memory(const Model& model, const ConstrainedSet& set);

/// Throws SolveError, naming both numbers and the next cheaper mode, when `cost` exceeds the memory left.
void require_memory(const Cost& cost, const Method& method);

}  // namespace elastolab
