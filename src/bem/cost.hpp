#pragma once

#include "deform/method.hpp"

namespace elastolab {

Cost predict_constant_bem(const SurfaceMesh& surface, const Method& method);
Cost predict_linear_bem(const SurfaceMesh& surface, const Method& method);
Cost predict_galerkin_bem(const SurfaceMesh& surface, const Method& method);

/// Whether Galerkin and linear BEM keep their operators as hierarchical matrices: on demand, on surfaces for which that
/// is cheaper.
bool is_hierarchical(const SurfaceMesh& surface, const Method& method);
/// Number of scalar tractions of a constrained set up to which the single layer is then factorised: 0.3 GB.
constexpr std::int64_t kMostFactorisedTractions = 6000;
/// Bytes of a constrained set by iteration: its tractions, the preconditioner and vectors. n_loaded: triangles that
/// carry tractions, those of surfaces with rigid fields too.
std::uint64_t hierarchical_set_memory(std::int64_t n_vertices, std::int64_t n_loaded, std::int64_t n_tractions);
/// The same by linear collocation. n_points: equations, n_slots: tractions, three scalars each.
std::uint64_t collocation_set_memory(std::int64_t n_vertices, std::int64_t n_points, std::int64_t n_slots);

}  // namespace elastolab
