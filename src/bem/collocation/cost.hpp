#pragma once

#include "deform/method.hpp"

namespace elastolab {

Cost predict_constant_bem(const SurfaceMesh& surface, const Method& method);
Cost predict_linear_bem(const SurfaceMesh& surface, const Method& method);

/// Bytes of a constrained set by iteration: its tractions, the preconditioner and vectors. n_points: equations,
/// n_slots: tractions, three scalars each.
std::uint64_t collocation_set_memory(std::int64_t n_vertices, std::int64_t n_points, std::int64_t n_slots);

}  // namespace elastolab
