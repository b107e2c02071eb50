#pragma once

#include <cstdint>

#include "deform/method.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// What a precomputation would take, before it is begun. Seconds are an estimate from the arithmetic it needs and from
/// the speed of this machine's matrix product, measured once; memory is what the model's arrays add up to. What a
/// constrained set takes beyond this: Deformer::predict_memory.
struct Cost {
    std::int64_t degrees_of_freedom = 0;
    std::uint64_t memory_bytes = 0;  ///< at its peak, beyond what the program holds already
    double seconds = 0.0;
};

/// FEM: the number of tetrahedra is estimated from the volume and the mean edge length of the surface.
Cost predict_cost(const SurfaceMesh& mesh, const Method& method);

/// Throws SolveError, naming both numbers and the next cheaper mode, when `cost` exceeds the memory left.
void require_memory(const Cost& cost, const Method& method);

}  // namespace elastolab
