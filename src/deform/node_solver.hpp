#pragma once

#include <Eigen/Core>

namespace elastolab {

/// Answer of a node solver, one column per column of prescribed values.
struct NodeSolution {
    Eigen::MatrixXd displacements;  ///< 3*n_nodes x m [L]
    Eigen::MatrixXd loads;          ///< 3*n_load_slots x m, for unit Young's modulus: nodal forces (FEM) or the
                                    ///< coefficients of the tractions (BEM); empty unless asked for
};

/// Displacements of all nodes from those prescribed at the constrained ones. Immutable.
class NodeSolver {
public:
    virtual ~NodeSolver() = default;

    /// prescribed  3*n_constrained_nodes x m, in the order of the constrained nodes
    virtual NodeSolution solve(const Eigen::MatrixXd& prescribed, bool want_loads) const = 0;

    /// Condition number of the system that is solved, 1-norm, estimated.
    double condition() const { return condition_; }
    /// False when the constraints leave some rigid motion free.
    bool held() const { return held_; }

protected:
    double condition_ = 1.0;
    bool held_ = true;
};

}  // namespace elastolab
