#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "base/control.hpp"
#include "bem/collocation/hierarchical_entries.hpp"
#include "bem/collocation/hierarchical_loads.hpp"
#include "bem/collocation/traction_space.hpp"
#include "bem/hierarchical/recycled_solutions.hpp"
#include "deform/linear_operator.hpp"
#include "deform/load_columns.hpp"
#include "deform/node_solver.hpp"
#include "deform/unit_load.hpp"

namespace elastolab {

/// H of linear collocation over a whole surface with unit Young's modulus, hierarchical. Immutable; any thread may use
/// it.
class HierarchicalCollocation {
public:
    /// tolerance: of the integrals, relative. Throws Cancelled.
    HierarchicalCollocation(std::shared_ptr<const Boundary> boundary, const Material& material, double tolerance,
                            Control& control);

    const Boundary& boundary() const { return *boundary_; }
    const Material& material() const { return material_; }
    double tolerance() const { return tolerance_; }
    const HierarchicalOptions& options() const { return options_; }
    /// The single layer of given loads at the vertices, 3*n_vertices x loads.size(); kept.
    Eigen::MatrixXd given_at_vertices(std::span<const UnitLoad> loads, Control& control) const;
    /// Rigid motions of all vertices, orthonormal: 3*n_vertices x 6.
    const std::shared_ptr<const Eigen::MatrixXd>& modes() const { return modes_; }
    const ClusteredElements& elements() const { return elements_; }
    const HierarchicalDoubleLayer& at_vertices() const { return H_; }
    /// The double layer seen from other points.
    std::unique_ptr<const HierarchicalDoubleLayer> seen_from(CollocationPoints points, Control& control) const;
    /// What a constrained set adds; see CollocationLoads. Throws Cancelled.
    std::shared_ptr<const CollocationLoads> loads_of(const TractionSpace& space, Control& control) const {
        return living_.add(
            [&](const auto& known) { return std::make_shared<const CollocationLoads>(*this, space, known, control); });
    }
    std::uint64_t memory_bytes() const { return H_.memory_bytes(); }

private:
    std::shared_ptr<const Boundary> boundary_;
    Material material_;
    double tolerance_;
    HierarchicalOptions options_;
    std::shared_ptr<const Eigen::MatrixXd> modes_;
    ClusteredElements elements_;
    HierarchicalDoubleLayer H_;
    mutable LivingLayers<CollocationLoads> living_;
    mutable ColumnCache given_{kLoadColumnBytes};
};

/// The equations of one constrained set (MixedProblem in bem/collocation/mixed_solver.hpp), with hierarchical matrices.
/// Unknowns: the displacements of the free vertices, then the tractions in the order of their slots. Equations, one for
/// each: at the free vertices, then at the constrained vertices whose hats carry tractions, then at the interior
/// points. Rigid motions that the constraints leave free are shifted: solutions have none of them. (The discrete
/// equations may then be inconsistent; they hold up to a combination of these motions, as with the bordered matrix.)
class CollocationProblem : public LinearOperator {
public:
    /// constrained: vertices; loads: given ones. Throws NotHeldError with `must_hold`, Cancelled.
    CollocationProblem(std::shared_ptr<const HierarchicalCollocation> matrices, const TractionSpace& space,
                       std::vector<int> constrained, std::span<const UnitLoad> loads, bool must_hold, Control& control);

    Eigen::Index size() const override { return 3 * (std::ssize(free_) + n_slots()); }
    Eigen::MatrixXd product(const Eigen::MatrixXd& X) const override;
    /// The same for columns that are zero in most places. Throws Cancelled.
    Eigen::MatrixXd sparse_product(const SparseColumns& Z, Control& control) const;
    /// -A u for prescribed displacements of the constrained vertices, and what the given loads add by their factors,
    /// which stand below.
    Eigen::MatrixXd right_side(const Eigen::MatrixXd& prescribed) const;
    /// Displacements of all vertices over the tractions of all slots, from a solution.
    Eigen::MatrixXd assemble_answer(const Eigen::MatrixXd& prescribed, const Eigen::MatrixXd& X) const;
    /// The solution that such an answer is made of.
    Eigen::MatrixXd unknowns_of(const Eigen::MatrixXd& answer) const;

    bool holds_the_body() const { return free_modes_.cols() == 0; }
    int n_vertices() const { return matrices_->elements().n_slots(); }
    int n_slots() const { return loads_->n_slots(); }
    int n_free() const { return static_cast<int>(free_.size()); }
    /// Where each equation is asked to hold.
    const Positions& points() const { return points_; }
    const CollocationLoads& loads() const { return *loads_; }
    /// The block of these equations and the unknowns of the same numbers (ascending).
    Eigen::MatrixXd block(const std::vector<int>& numbers) const;
    std::uint64_t memory_bytes() const { return loads_->memory_bytes(); }

private:
    Eigen::MatrixXd equations(const Eigen::MatrixXd& displacements) const;
    /// Of rows for all vertices and the interior points, those of the equations.
    Eigen::MatrixXd rows_of_equations(const Eigen::MatrixXd& everywhere) const;

    std::shared_ptr<const HierarchicalCollocation> matrices_;
    std::vector<int> free_, constrained_;
    std::vector<int> at_;  ///< vertices of the first equations; interior points follow
    std::shared_ptr<const CollocationLoads> loads_;
    Positions points_;
    double traction_scale_;  ///< [force / L^2] over [L], so that tractions and displacements count alike
    Eigen::MatrixXd free_modes_, shift_;
    Eigen::MatrixXd given_;  ///< single layer of the given loads in every equation
};

/// Displacements and tractions of one constrained set by linear collocation, by preconditioned GMRES. Answers are kept:
/// prescribed displacements that are a combination of earlier ones cost no iteration.
class CollocationSolver : public NodeSolver {
public:
    /// Where the constraints leave a rigid motion free, the solution without it is taken; with `must_hold` NotHeldError
    /// is thrown. Throws SolveError, Cancelled.
    CollocationSolver(std::shared_ptr<const HierarchicalCollocation> matrices, const TractionSpace& space,
                      const std::vector<int>& constrained, std::span<const UnitLoad> loads, bool must_hold,
                      Control& control);
    ~CollocationSolver() override;

    NodeSolution solve(const Eigen::MatrixXd& prescribed, bool want_loads) const override;
    NodeSolution solve_watched(const Eigen::MatrixXd& prescribed, bool want_loads, double tolerance,
                               Control& control) const override;
    bool iterates() const override { return true; }

    const CollocationProblem& problem() const { return problem_; }

private:
    /// Displacements over tractions.
    Eigen::MatrixXd iterate(const Eigen::MatrixXd& prescribed, const Eigen::MatrixXd& start, double tolerance,
                            Control& control) const;

    CollocationProblem problem_;
    std::unique_ptr<const LinearOperator> preconditioner_;
    mutable RecycledSolutions recycled_;
};

/// An approximate inverse of a collocation problem, in two levels: overlapping patches of its points, each solved by
/// itself (restricted additive Schwarz, in single precision), and, before them, rigid motions and constant tractions of
/// one or two dozen parts. Source: X.-C. Cai and M. Sarkis, SIAM J. Sci. Comput. 21 (1999).
std::unique_ptr<const LinearOperator> make_collocation_preconditioner(const CollocationProblem& problem,
                                                                      Control& control);

}  // namespace elastolab
