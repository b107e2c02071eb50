#include "deform/solid_model.hpp"

#include <cassert>
#include <Eigen/Geometry>

namespace elastolab {

Reactions gathered_reactions(const std::vector<LoadShare>& shares, int n, const Eigen::VectorXd& loads) {
    Reactions reactions{Eigen::Matrix3Xd::Zero(3, n), Eigen::Matrix3Xd::Zero(3, n)};
    for (const LoadShare& share : shares) {
        const Eigen::Vector3d load = loads.segment<3>(3 * share.slot);
        reactions.forces.col(share.constrained) += share.weight * load;
        reactions.moments.col(share.constrained) += share.first_moment.cross(load);
    }
    return reactions;
}

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

NodeSolution ConstrainedSolid::solve(const NodeTask& task, double tolerance, Control& control) const {
    assert(task.prescribed.rows() == nodes_.prescribe.cols());
    const auto of_nodes = [&](const Eigen::MatrixXd& of_vertices) -> Eigen::MatrixXd {
        return of_vertices.cols() > 0 ? Eigen::MatrixXd(nodes_.prescribe * of_vertices) : Eigen::MatrixXd();
    };
    const NodeTask own{of_nodes(task.prescribed), of_nodes(task.changes), task.start, of_nodes(task.path),
                       task.want_loads};
    NodeSolution solution = solver_->solve_task(own, tolerance, control);
    if (!solver_->linear()) solution.prescribed = task.prescribed;
    return solution;
}

NodeSolution ConstrainedSolid::solve(const Eigen::MatrixXd& values, bool want_loads, double tolerance,
                                     Control& control) const {
    return solve(NodeTask{.prescribed = values, .want_loads = want_loads}, tolerance, control);
}

NodeSolution ConstrainedSolid::solve(const Eigen::MatrixXd& values, bool want_loads) const {
    Control control;
    return solve(values, want_loads, kSolveTolerance, control);
}

Eigen::MatrixXd ConstrainedSolid::displacements(NodeSolution&& solution) const {
    if (display_) return *display_ * solution.displacements;
    if (solution.displacements.rows() == 3 * n_vertices_) return std::move(solution.displacements);
    return solution.displacements.topRows(3 * n_vertices_);
}

Reactions ConstrainedSolid::reactions(const NodeSolution& solution) const {
    Reactions reactions = gathered_reactions(shares_, n_constrained_, solution.loads.col(0));
    if (solver_->linear()) return reactions;
    for (const LoadShare& share : shares_) {
        const Eigen::Vector3d load = solution.loads.col(0).segment<3>(3 * share.slot);
        const Eigen::Vector3d moved = share.weight * solution.prescribed.col(0).segment<3>(3 * share.constrained);
        reactions.moments.col(share.constrained) += moved.cross(load);
    }
    return reactions;
}

double ConstrainedSolid::residual(const NodeSolution& solution, Control& control) const {
    return checks_.residual(solution, control);
}

std::shared_ptr<const InteriorField> ConstrainedSolid::inside(NodeSolution&& solution, Control& control) const {
    return checks_.inside(std::move(solution), control);
}

std::optional<SolutionError> ConstrainedSolid::error(const Eigen::VectorXd& values, const NodeSolution& solution,
                                                     Control& control) const {
    if (!checks_.reference) return {};
    const std::optional<ReferenceAnswer> reference = checks_.reference(values, solution, control);
    if (!reference) return {};
    const Eigen::VectorXd u =
        display_ ? Eigen::VectorXd(*display_ * solution.displacements.col(0))
                 : Eigen::VectorXd(solution.displacements.col(0).head(3 * static_cast<Eigen::Index>(n_vertices_)));
    const Reactions own = reactions(solution);
    return SolutionError{reference->share * (reference->displacements - u),
                         {reference->share * (reference->reactions.forces - own.forces),
                          reference->share * (reference->reactions.moments - own.moments)},
                         reference->share > 0.0 ? 1.0 / reference->share : 0.0};
}

}  // namespace elastolab
