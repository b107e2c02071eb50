#pragma once

#include <Eigen/Core>

#include "base/control.hpp"
#include "deform/iteration.hpp"
#include "deform/linear_operator.hpp"

namespace elastolab {

struct GmresOptions {
    double tolerance = kSolveTolerance;  ///< of the residual, relative to the right side, Euclidean, for each column
    Eigen::MatrixXd start = {};          ///< what may be near X; empty: zero
    int max_iterations = 1000;
    int basis = 100;
};

/// X with A X = B for any nonsingular A, by flexible GMRES, preconditioned from the right, all columns at once: each
/// has its own iteration, but they share the products. `preconditioner`: about A^-1, nearly linear (it may round to
/// floats). Restarts when its basis of `options.basis` vectors is full. The residual is that of A X = B
/// itself. Tells `control` its progress, and may be cancelled in every iteration. Throws SolveError naming `name` when
/// the tolerance is not reached, Cancelled. Source: Y. Saad, SIAM J. Sci. Comput. 14 (1993).
Eigen::MatrixXd gmres(const LinearOperator& A, const LinearOperator& preconditioner, const Eigen::MatrixXd& B,
                      const GmresOptions& options, const char* name, Control& control,
                      IterationReport* report = nullptr);

}  // namespace elastolab
