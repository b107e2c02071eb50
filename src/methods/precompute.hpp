#pragma once

#include <memory>

#include "base/control.hpp"
#include "deform/model.hpp"

namespace elastolab {

/// Precomputes; milliseconds to minutes, meant for a worker thread. Memory is judged before anything else is done.
/// Throws MeshError (no tetrahedralisation), SolveError (a combination that is not possible, see refusal(); singular;
/// or would not fit in memory: says how much it needs before anything is allocated), Cancelled.
std::shared_ptr<const Model> precompute(const Body& body, const Method& method, Control& control);

/// The same body with another material or method; takes over whatever does not change. A change of Young's modulus
/// costs nothing. A change of Poisson's ratio needs no new integrals for FEM, nor, after the first such change, for
/// symmetric Galerkin BEM up to 1900 vertices (but for the rows of constrained triangles). Throws as precompute does.
std::shared_ptr<const Model> precompute_again(const Model& before, const Material& material, const Method& method,
                                              Control& control);

}  // namespace elastolab
