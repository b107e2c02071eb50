#pragma once

#include <Eigen/Core>

#include "base/control.hpp"
#include "deform/iteration.hpp"
#include "deform/linear_operator.hpp"

namespace elastolab {

struct IterationOptions {
    double tolerance = kSolveTolerance;  ///< of the residual, relative to the right side, Euclidean, for each column
    /// Of the energy norm of a column's error, as the preconditioner tells it, over that of the start's: a column ends
    /// here, too.
    double energy_tolerance = 0.0;
    Eigen::MatrixXd start = {};  ///< what may be near X; empty: zero
    int max_iterations = 1000;
    /// false: what is there after max_iterations is the answer, or before a direction that is not positive
    bool must_converge = true;
};

/// X with A X = B for A symmetric positive definite (or semidefinite, with B in its range), by conjugate gradients, all
/// columns at once: each has its own iteration, but they share the products. `preconditioner`: symmetric positive
/// definite, about A^-1. `report` is kept up to date: an operator may read there how exact a product
/// must be, since errors in late products matter less (Simoncini and Szyld 2003, van den Eshof and Sleijpen 2004).
/// Tells `control` its progress, and may be cancelled in every iteration. Throws SolveError naming `name` when the
/// tolerance is not reached though it must be, or something is no number; Cancelled.
Eigen::MatrixXd conjugate_gradients(const LinearOperator& A, const LinearOperator& preconditioner,
                                    const Eigen::MatrixXd& B, const IterationOptions& options, const char* name,
                                    Control& control, IterationReport* report = nullptr);

}  // namespace elastolab
