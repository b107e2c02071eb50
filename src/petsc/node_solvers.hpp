#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "base/control.hpp"
#include "deform/node_solver.hpp"
#include "deform/reduced_solver.hpp"
#include "petsc/stiffness.hpp"

namespace elastolab {

/// Eqn. 7 on a distributed stiffness: the displacements of all nodes. The nodes hold the body, else NotHeldError.
class PetscHeldSolver : public NodeSolver {
public:
    /// given: nodal forces of unit loads, 3*n_nodes x n_loads
    PetscHeldSolver(std::shared_ptr<PetscStiffness> stiffness, const Positions& positions, std::vector<int> nodes,
                    Eigen::MatrixXd given, Control& control);
    NodeSolution solve(const Eigen::MatrixXd& prescribed, bool want_loads) const override;
    /// To kPetscTolerance, whatever is asked for.
    NodeSolution solve_watched(const Eigen::MatrixXd& prescribed, bool want_loads, double tolerance,
                               Control& control) const override;

private:
    std::shared_ptr<PetscStiffness> stiffness_;
    std::vector<int> nodes_;
    Eigen::MatrixXd given_;
};

/// Eqn. (9') on a free body, for few nodes, which do not hold it: the columns of all of these for all nodes, by the
/// body on six springs, as in fem/compliance.hpp.
class PetscFreeSolver : public NodeSolver {
public:
    /// n_surface: nodes on the surface, the first ones
    PetscFreeSolver(PetscStiffness& stiffness, const Positions& positions, int n_surface, const std::vector<int>& nodes,
                    const Eigen::MatrixXd& given, Control& control);
    NodeSolution solve(const Eigen::MatrixXd& prescribed, bool want_loads) const override {
        return reduced_->solve(prescribed, want_loads);
    }
    NodeSolution solve_watched(const Eigen::MatrixXd& prescribed, bool want_loads, double tolerance,
                               Control& control) const override {
        return reduced_->solve_watched(prescribed, want_loads, tolerance, control);
    }

private:
    std::unique_ptr<const ReducedSolver> reduced_;
};

/// |K u - f| / | |K| |u| + |f| |, Euclidean, for displacements of all nodes and forces at these nodes beside those
/// given at all nodes.
double petsc_residual(const PetscStiffness& K, const Eigen::MatrixXd& u, const std::vector<int>& nodes,
                      const Eigen::MatrixXd& forces, const Eigen::MatrixXd& given, Control& control);

}  // namespace elastolab
