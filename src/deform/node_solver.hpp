#pragma once

#include <Eigen/Core>
#include <memory>

#include "base/control.hpp"
#include "base/error.hpp"
#include "deform/equilibrium.hpp"
#include "deform/iteration.hpp"

namespace elastolab {

/// The system of a constrained set is singular, mostly because the constraints leave a rigid motion free, and the
/// update has no answer for that (the reduced one has).
class NotHeldError : public SolveError {
public:
    using SolveError::SolveError;
    NotHeldError()
        : SolveError(
              "constraints: leave the body free to move as a whole. Constrain three vertices that are not on one "
              "line, or use the reduced update, which takes the smallest motion.") {}
};

/// Said of a constrained set that holds the body and has a singular system all the same.
inline constexpr const char* kSingularThoughHeld =
    "constraints: hold the body, but their system is singular to rounding, as that of constant elements can be at "
    "Poisson's ratio 1/2. Choose another method, or constrain other vertices.";

/// Answer of a node solver, one column per column of prescribed values.
struct NodeSolution {
    Eigen::MatrixXd displacements;  ///< 3*n_nodes x m [L]
    Eigen::MatrixXd loads;          ///< 3*n_load_slots x m, for unit Young's modulus: nodal forces (FEM) or the
                                    ///< coefficients of the tractions (BEM), of the supports alone; empty unless
                                    ///< asked for
    Eigen::MatrixXd prescribed;     ///< what it is a solution for, of methods that are not linear; else empty
    Eigen::MatrixXd factors = {};   ///< n_unit_loads x m, of the given loads
    std::shared_ptr<const NodeState> state = nullptr;  ///< of the last column, of methods that are not linear
    /// Likewise of the first column, where loads are asked for: force over moment about the origin that each given load
    /// exerts at present positions, 6 x n_unit_loads.
    Eigen::MatrixXd resultants = {};
};

/// What a node solver is asked for at once.
struct NodeTask {
    Eigen::MatrixXd prescribed;  ///< as NodeSolver::solve takes it: 3*n_constrained_nodes + n_unit_loads x m
    /// The same, x k: changes of the first column of `prescribed`; wanted are the derivatives of its
    /// solution along them, and of its loads where those are wanted.
    Eigen::MatrixXd changes = {};
    const NodeState* start = nullptr;  ///< as in Approach; null: rest
    Eigen::MatrixXd path = {};         ///< as in Approach, of the constrained nodes
    bool want_loads = false;
    int most_steps = kMostEquilibriumSteps;  ///< as in Approach
};

/// Displacements of all nodes from those prescribed at the constrained ones. Immutable.
class NodeSolver {
public:
    virtual ~NodeSolver() = default;

    /// prescribed  3*n_constrained_nodes + n_unit_loads x m: displacements in the order of the constrained nodes, then
    ///             a factor for each unit load that the solver was made with
    virtual NodeSolution solve(const Eigen::MatrixXd& prescribed, bool want_loads) const = 0;
    /// The same; where it iterates, to this relative residual, it tells its progress and can be cancelled. Throws
    /// SolveError, Cancelled.
    virtual NodeSolution solve_watched(const Eigen::MatrixXd& prescribed, bool want_loads, double /*tolerance*/,
                                       Control&) const {
        return solve(prescribed, want_loads);
    }
    /// Solutions for the columns of `prescribed`, then the derivatives along those of `changes`. A method that is
    /// linear has nothing to begin from, and its derivatives are solutions.
    virtual NodeSolution solve_task(const NodeTask& task, double tolerance, Control& control) const {
        if (task.changes.cols() == 0) return solve_watched(task.prescribed, task.want_loads, tolerance, control);
        Eigen::MatrixXd all(task.prescribed.rows(), task.prescribed.cols() + task.changes.cols());
        all << task.prescribed, task.changes;
        return solve_watched(all, task.want_loads, tolerance, control);
    }
    /// Whether displacements are linear in what is prescribed.
    virtual bool linear() const { return true; }
    /// False where solutions are as exact as rounding lets them be, whatever the tolerance.
    virtual bool iterates() const { return false; }

    /// Condition number of the system that is solved, 1-norm, estimated.
    double condition() const { return condition_; }
    /// False when the constraints leave some rigid motion free.
    bool held() const { return held_; }

protected:
    double condition_ = 1.0;
    bool held_ = true;
};

}  // namespace elastolab
