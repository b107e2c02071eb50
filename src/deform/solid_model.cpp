#include "deform/solid_model.hpp"

#include <cassert>
#include <Eigen/Geometry>

namespace elastolab {

ConstrainedSolid::ConstrainedSolid(int n_vertices, ConstrainedNodes nodes, std::vector<LoadShare> shares,
                                   std::shared_ptr<const SparseRows> display, std::unique_ptr<NodeSolver> solver,
                                   SolutionChecks checks)
    : n_vertices_(n_vertices),
      n_constrained_(static_cast<int>(nodes.prescribe.cols() / 3)),
      nodes_(std::move(nodes)),
      shares_(std::move(shares)),
      display_(std::move(display)),
      solver_(std::move(solver)),
      checks_(std::move(checks)) {}

NodeSolution ConstrainedSolid::solve(const Eigen::MatrixXd& values, bool want_loads, Control& control) const {
    assert(values.rows() == nodes_.prescribe.cols());
    return solver_->solve_watched(nodes_.prescribe * values, want_loads, control);
}

NodeSolution ConstrainedSolid::solve(const Eigen::MatrixXd& values, bool want_loads) const {
    Control control;
    return solve(values, want_loads, control);
}

Eigen::MatrixXd ConstrainedSolid::displacements(NodeSolution&& solution) const {
    if (display_) return *display_ * solution.displacements;
    if (solution.displacements.rows() == 3 * n_vertices_) return std::move(solution.displacements);
    return solution.displacements.topRows(3 * n_vertices_);
}

Reactions ConstrainedSolid::reactions(const NodeSolution& solution) const {
    Reactions reactions{Eigen::Matrix3Xd::Zero(3, n_constrained_), Eigen::Matrix3Xd::Zero(3, n_constrained_)};
    for (const LoadShare& share : shares_) {
        const Eigen::Vector3d load = solution.loads.col(0).segment<3>(3 * share.slot);
        reactions.forces.col(share.constrained) += share.weight * load;
        reactions.moments.col(share.constrained) += share.first_moment.cross(load);
    }
    return reactions;
}

double ConstrainedSolid::residual(const NodeSolution& solution, Control& control) const {
    return checks_.residual(solution, control);
}

Eigen::VectorXd ConstrainedSolid::error(const NodeSolution& solution, Control& control) const {
    if (!checks_.error) return {};
    return checks_.error(*solver_, solution, control);
}

}  // namespace elastolab
