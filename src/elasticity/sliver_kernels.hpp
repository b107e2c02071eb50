#pragma once

#include "elasticity/triangle_kernels.hpp"

// Plain arrays only: this header is also read by sources compiled for particular instruction sets.

namespace elastolab {

/// Closed forms over a sliver, in extended precision (long double): cancellation multiplies its rounding errors by
/// (edge / altitude)^2, which leaves 1e-12 at an altitude of 1e-3 edges and
/// 1e-9 at 1e-4 with the 64 bits of x86. Far slower than the vectorised kernels, but
/// slivers are rare.
/// Arguments as in TriangleKernels, for `lanes` sources; `linear`: three shape functions instead of the constant.
void add_single_layer_of_sliver(const TriangleGeometry& triangle, const SourceLanes& sources, int lanes, bool linear,
                                double* const* out);
void add_double_layer_of_sliver(const TriangleGeometry& triangle, const SourceLanes& sources, int lanes, bool linear,
                                double* const* out);
void add_potential_of_sliver(const TriangleGeometry& triangle, const SourceLanes& sources, int lanes, Potential wanted,
                             double* out);

}  // namespace elastolab
