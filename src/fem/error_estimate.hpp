#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <optional>
#include <span>

#include "base/control.hpp"
#include "deform/solid_model.hpp"
#include "fem/solvers.hpp"

namespace elastolab {

/// The answer that linear tetrahedra are judged by: quadratic elements on the same tetrahedra, solved by conjugate
/// gradients to a few per cent in energy. Two levels precondition them: the factorised linear stiffness on the corners,
/// and the diagonal blocks of the midpoints; their number of steps does not depend on the size of the mesh. Nothing
/// where the constraints do not hold the body or memory does not suffice.
/// vertices  constrained, all different
/// loads     unit loads
/// values    the vertices' displacements, 3*vertices.size(), then a factor for each load
/// Throws SolveError, Cancelled.
std::optional<ReferenceAnswer> quadratic_reference(const FemSystem& linear, double poisson_ratio,
                                                   std::span<const int> vertices, std::span<const UnitLoad> loads,
                                                   const Eigen::VectorXd& values, Control& control);

/// Bytes that these references take.
std::uint64_t quadratic_reference_memory(const FemSystem& linear);
std::uint64_t linear_reference_memory(const FemSystem& quadratic);

/// The answer that quadratic tetrahedra are judged by: linear ones, whose space is part of theirs. What the second
/// degree changed indicates what a third would.
std::optional<ReferenceAnswer> linear_reference(const FemSystem& quadratic, std::span<const int> vertices,
                                                std::span<const UnitLoad> loads, const Eigen::VectorXd& values,
                                                Control& control);

}  // namespace elastolab
