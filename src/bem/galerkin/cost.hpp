#pragma once

#include "deform/method.hpp"

namespace elastolab {

/// Whether a body's model is hierarchical: its surface is large, or that of a usual set with finer rims is.
bool has_hierarchical_model(const SurfaceMesh& surface, const Method& method);

Cost predict_galerkin_bem(const SurfaceMesh& surface, const Method& method);

/// What one answer takes with dense matrices, D and all, for a set of so many constrained triangles and loads
/// on so many triangles: predictions of the method do not know them.
Work predict_galerkin_answer(const SurfaceMesh& surface, std::int64_t n_constrained, std::int64_t n_loaded);
/// Bytes of one answer on a surface as it is, all that is computed for it. n_loaded, n_tractions: as in
/// hierarchical_set_memory.
std::uint64_t galerkin_answer_memory(const SurfaceMesh& surface, const Method& method, std::int64_t n_loaded,
                                     std::int64_t n_tractions);

/// Bytes of hierarchical matrices on a surface as it is.
std::uint64_t hierarchical_memory(const SurfaceMesh& surface);
/// With hierarchical matrices: number of scalar tractions of a constrained set up to which the single layer is
/// factorised: 0.3 GB.
constexpr std::int64_t kMostFactorisedTractions = 6000;
/// Bytes of a constrained set by iteration: its tractions, the preconditioner and vectors. n_loaded: triangles that
/// carry tractions, those of surfaces with rigid fields too.
std::uint64_t hierarchical_set_memory(std::int64_t n_vertices, std::int64_t n_loaded, std::int64_t n_tractions);

}  // namespace elastolab
