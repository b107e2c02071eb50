#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "base/control.hpp"
#include "deform/solid_model.hpp"
#include "fem/nonlinear/mesh.hpp"
#include "fem/nonlinear/newton.hpp"

namespace elastolab {

/// Up to this Poisson's ratio one step on halved elements leads near their answer, and four-node elements do not lock.
inline constexpr double kCompressible = 0.45;

/// The answer that ten-node elements are judged by under large deformations: the same with all edges halved, by one
/// step of Newton's method from the state that is judged. It is solved as halved_reference is (fem/error_estimate.hpp),
/// with the factorised tangent of that state. Nothing where an element that is halved has no positive volume, or either
/// tangent is not positive definite, or, next to a Poisson's ratio of 1/2, the step leaves much of the residual, as in
/// nearly incompressible bodies that are stretched far.
/// newton        of the ten-node elements
/// vertices      constrained, all different; they hold the body
/// displacements of all nodes of the ten-node elements; factors: of the loads
/// Throws SolveError, Cancelled.
std::optional<ReferenceAnswer> halved_answer(const NonlinearMesh& mesh, const Newton& newton,
                                             const std::vector<int>& vertices, std::span<const UnitLoad> loads,
                                             const Eigen::VectorXd& displacements, const Eigen::VectorXd& factors,
                                             Control& control);

/// Bytes that it takes beside the tangent and its factor.
std::uint64_t halved_answer_memory(const NonlinearMesh& mesh);

}  // namespace elastolab
