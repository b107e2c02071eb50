#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include "deform/node_solver.hpp"

namespace elastolab {

/// A stiffness as Eqn. 7 needs it, wherever it lies.
struct HeldStiffness {
    using Product = std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>;
    Product multiply;  ///< K u of all nodes
    Product solve;     ///< with the constrained nodes eliminated; the forces there are zero
};

/// Eqn. 7: displacements of all nodes, and forces of the supports where they are wanted.
/// given: nodal forces of unit loads, 3*n_nodes x n_loads; prescribed: as NodeSolver::solve takes it
NodeSolution solve_held(const HeldStiffness& K, const std::vector<int>& nodes, const Eigen::MatrixXd& given,
                        const Eigen::MatrixXd& prescribed, bool want_loads);

/// |K u - f| / | |K| |u| + |f| |, Euclidean, for one column: products K u and |K| |u|, and forces at these nodes beside
/// those given at all nodes.
double force_residual(const Eigen::VectorXd& products, const Eigen::VectorXd& sizes, std::span<const int> nodes,
                      const Eigen::MatrixXd& forces, const Eigen::VectorXd& given);

}  // namespace elastolab
