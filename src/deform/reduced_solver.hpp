#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "base/lapack.hpp"
#include "deform/columns.hpp"
#include "deform/node_solver.hpp"

namespace elastolab {

/// The small system of FORMULATION section 2: with W the responses to unit loads, [E; J] the response to unit border
/// values c and F the border rows of W,
///     u = W_u q + E c,    u at the constrained nodes prescribed,    F q + J c = 0,    closing rows [q; c] = 0.
struct ReducedSystem {
    Columns columns;           ///< W over F: (3*n_nodes + n_border) x n_unknown_loads
    Eigen::MatrixXd rigid;     ///< E over J: (3*n_nodes + n_border) x n_border
    std::vector<int> nodes;    ///< constrained nodes
    Eigen::MatrixXd closing;   ///< extra rows, n_extra x (n_unknown_loads + n_border); none for square ansatzes
    Eigen::Index n_loads = 0;  ///< the first so many unknowns are loads, the others residuals of dropped rows
};

/// Eqn. (9'), the collapsed form of the paper's Eqn. 9. One factorisation of the small system; a solve costs its
/// substitution and one product with W.
class ReducedSolver : public NodeSolver {
public:
    explicit ReducedSolver(ReducedSystem system);
    NodeSolution solve(const Eigen::MatrixXd& prescribed, bool want_loads) const override;

private:
    Eigen::MatrixXd unknowns(const Eigen::MatrixXd& prescribed) const;

    ReducedSystem system_;
    Eigen::VectorXd scale_;  ///< columns of the small system are divided by these
    LuFactorization lu_;
    Eigen::MatrixXd deficient_;  ///< the small system itself, kept only when it is rank-deficient
};

/// u at the constrained nodes <- what was prescribed, which it equals but for rounding.
void set_prescribed(const std::vector<int>& nodes, const Eigen::MatrixXd& prescribed, Eigen::MatrixXd& displacements);

}  // namespace elastolab
