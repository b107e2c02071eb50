#pragma once

#include <Eigen/Core>
#include <span>

#include "base/control.hpp"
#include "fem/sparse_cholesky.hpp"
#include "fem/sparse_matrix.hpp"

namespace elastolab {

/// Solution of K u = f with u prescribed at some nodes and f given at the others.
struct PrescribedSolution {
    Eigen::MatrixXd displacements;  ///< 3n x m, all nodes [L]
    Eigen::MatrixXd forces;  ///< 3*nodes.size() x m, on the body at the prescribed nodes, without the given [force]
    double reciprocal_condition = 0.0;  ///< 1-norm estimate, of K_ff with the diagonal of K for the prescribed nodes
};

/// Eqn. 7 for a sparse stiffness: factorises K_ff afresh (its symbolic analysis is that of K, which is reused).
/// nodes   all different; they hold the body (fem/constraints.hpp), else the system is singular
/// values  3*nodes.size() x m, node-major, in the order of `nodes`
/// given   f at all nodes, 3n x m; empty: zero
/// Throws SolveError, Cancelled.
PrescribedSolution solve_prescribed(const SparseMatrix& K, const CholeskyAnalysis& analysis, std::span<const int> nodes,
                                    const Eigen::MatrixXd& values, Control& control, const Eigen::MatrixXd& given = {});

}  // namespace elastolab
