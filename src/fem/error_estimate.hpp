#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>

#include "base/control.hpp"
#include "deform/solid_model.hpp"
#include "fem/quadratic_mesh.hpp"
#include "fem/solvers.hpp"
#include "fem/sparse_cholesky.hpp"
#include "fem/two_levels.hpp"

namespace elastolab {

/// Error that quadratic elements leave, over how much they change the answer. Along the rim of a constrained patch
/// errors fall like 1 / degree^2, elsewhere faster; measured in tests/methods/discretisation_test.cpp.
inline constexpr double kLeftByQuadratic = 0.45;

/// The same of halving their edges.
inline constexpr double kLeftByHalving = 0.5;

/// IterationOptions::energy_tolerance of the answer on halved edges. Thirty times as much spares a third of the time,
/// and tells 17 times the error of a thin plate that a force bends: what is soft comes last.
inline constexpr double kEnoughOfHalved = 0.001;

/// Whether second answers are good enough. Next to a Poisson's ratio of 1/2 nearly all of the energy that they start
/// with is of volumes, and gone before the rest of the answer is there: at 0.499999999 errors seemed 400 times too
/// small.
constexpr bool can_be_judged(double poisson_ratio) { return 1.0 - 2.0 * poisson_ratio > 1e-5; }

/// What a second answer needs of the stiffness that is judged and of the finer one, wherever these are kept.
struct ReferenceOperators : TwoLevels::Operators {
    TwoLevels::Product coarse;  ///< forces for displacements of the nodes that are judged
};

using Factor = std::shared_ptr<const SparseCholesky>;

/// The answer that linear tetrahedra are judged by: quadratic elements on the same tetrahedra, solved by conjugate
/// gradients to a few per cent in energy. Two levels precondition them: the factorised linear stiffness on the corners,
/// and the diagonal blocks of the midpoints; their number of steps does not depend on the size of the mesh. A body that
/// is not held is pinned (deform/pinned_body.hpp). Nothing where memory does not suffice, or that cannot be judged.
/// vertices  constrained, all different
/// loads     unit loads
/// values    the vertices' displacements, 3*vertices.size(), then a factor for each load
/// first     the answer that is judged: displacements [L] that begin with those of the surface's vertices
/// held      factor of the stiffness with what these vertices prescribe eliminated, where it is at hand, else null
/// Throws SolveError, Cancelled.
std::optional<ReferenceAnswer> quadratic_reference(const FemSystem& linear, double poisson_ratio,
                                                   std::span<const int> vertices, std::span<const UnitLoad> loads,
                                                   const Eigen::VectorXd& values, const Eigen::VectorXd& first,
                                                   const Factor& held, Control& control);

/// The same with these operators, for vertices that hold the body. mesh: the quadratic elements on the tetrahedra of
/// the linear mesh.
ReferenceAnswer quadratic_reference(const QuadraticMesh& mesh, const FemMesh& linear, const ReferenceOperators& apply,
                                    std::span<const int> vertices, std::span<const UnitLoad> loads,
                                    const Eigen::VectorXd& values, Control& control);

/// Bytes that these references take; has_factor: where it is at hand.
std::uint64_t quadratic_reference_memory(const FemSystem& linear, bool has_factor);
std::uint64_t halved_reference_memory(const FemSystem& quadratic, bool has_factor);

/// The answer that quadratic tetrahedra are judged by: the same with all edges halved, by conjugate gradients in the
/// same way. Two levels precondition them: the stiffness of the tetrahedra that are judged, factorised for this set,
/// and the diagonal blocks of the new nodes.
std::optional<ReferenceAnswer> halved_reference(const FemSystem& quadratic, double poisson_ratio,
                                                std::span<const int> vertices, std::span<const UnitLoad> loads,
                                                const Eigen::VectorXd& values, const Eigen::VectorXd& first,
                                                const Factor& held, Control& control);

/// The same for vertices that hold the body, by the stiffness of the given elements: forces for displacements of all
/// nodes, and the displacements for forces where what the vertices prescribe is zero.
ReferenceAnswer halved_reference(const FemMesh& quadratic, double poisson_ratio, const TwoLevels::Product& stiffness,
                                 const TwoLevels::Product& solve, std::span<const int> vertices,
                                 std::span<const UnitLoad> loads, const Eigen::VectorXd& values, Control& control);

}  // namespace elastolab
