#pragma once

#include "deform/method.hpp"

namespace elastolab {

/// Whether Galerkin and linear BEM keep their operators as hierarchical matrices: on demand, on surfaces for which that
/// is cheaper.
bool is_hierarchical(const SurfaceMesh& surface, const Method& method);

/// Arithmetic per pair of point and triangle, in flops at the speed of the matrix product: about 0.1 us on a core.
constexpr double kFlopsPerPair = 3000.0;
/// Bytes that every boundary method needs besides its matrices.
constexpr std::uint64_t kLeastMemory = 12u << 20;

/// Levels of clusters of hierarchical matrices.
double cluster_levels(std::int64_t n_vertices);
/// Of a method with hierarchical matrices. bytes: per vertex and level of clusters; flops: beside the power 4/3 of the
/// number of vertices, with which time was measured to grow.
Cost predict_hierarchical(const SurfaceMesh& surface, double bytes, double flops);

}  // namespace elastolab
