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
                                   SolutionChecks checks, int n_loads, ParticularField particular)
    : n_vertices_(n_vertices),
      n_constrained_(static_cast<int>(nodes.prescribe.cols() / 3)),
      n_loads_(n_loads),
      nodes_(std::move(nodes)),
      shares_(std::move(shares)),
      display_(std::move(display)),
      solver_(std::move(solver)),
      checks_(std::move(checks)),
      particular_(std::move(particular)) {}

NodeSolution ConstrainedSolid::solve(const NodeTask& task, double tolerance, Control& control) const {
    const NodeTask own{of_nodes(task.prescribed), of_nodes(task.changes), task.start,
                       of_nodes(task.path),       task.want_loads,        task.most_steps};
    NodeSolution solution = solver_->solve_task(own, tolerance, control);
    solution.factors.resize(n_loads_, task.prescribed.cols() + task.changes.cols());
    solution.factors.leftCols(task.prescribed.cols()) = task.prescribed.bottomRows(n_loads_);
    if (task.changes.cols() > 0) solution.factors.rightCols(task.changes.cols()) = task.changes.bottomRows(n_loads_);
    if (!solver_->linear()) solution.prescribed = task.prescribed;
    return solution;
}

/// Values of the vertices and loads -> what the node solver takes.
Eigen::MatrixXd ConstrainedSolid::of_nodes(const Eigen::MatrixXd& values) const {
    if (values.cols() == 0) return {};
    const Eigen::Index n = nodes_.prescribe.cols(), n_nodes = nodes_.prescribe.rows();
    assert(values.rows() == n + n_loads_);
    Eigen::MatrixXd prescribed(n_nodes + n_loads_, values.cols());
    prescribed.topRows(n_nodes) = nodes_.prescribe * values.topRows(n);
    prescribed.bottomRows(n_loads_) = values.bottomRows(n_loads_);
    if (!particular_.empty())
        prescribed.topRows(n_nodes).noalias() -= particular_.at_nodes * values.bottomRows(n_loads_);
    return prescribed;
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
    Eigen::MatrixXd u;
    if (display_)
        u = *display_ * solution.displacements;
    else if (solution.displacements.rows() == 3 * n_vertices_)
        u = std::move(solution.displacements);
    else
        u = solution.displacements.topRows(3 * n_vertices_);
    add_particular(solution.factors, u);
    return u;
}

void ConstrainedSolid::add_particular(const Eigen::MatrixXd& factors, Eigen::Ref<Eigen::MatrixXd> displacements) const {
    if (!particular_.empty())
        displacements.noalias() += particular_.at_vertices.topRows(displacements.rows()) * factors;
}

Reactions present_reactions(const std::vector<LoadShare>& shares, const Eigen::VectorXd& moved,
                            const Eigen::VectorXd& loads) {
    Reactions reactions = gathered_reactions(shares, static_cast<int>(moved.size() / 3), loads);
    for (const LoadShare& share : shares) {
        const Eigen::Vector3d load = loads.segment<3>(3 * share.slot);
        const Eigen::Vector3d by = share.weight * moved.segment<3>(3 * share.constrained);
        reactions.moments.col(share.constrained) += by.cross(load);
    }
    return reactions;
}

Reactions ConstrainedSolid::reactions(const NodeSolution& solution) const {
    if (solver_->linear()) return gathered_reactions(shares_, n_constrained_, solution.loads.col(0));
    return present_reactions(shares_, solution.prescribed.col(0).head(3 * n_constrained_), solution.loads.col(0));
}

Eigen::Matrix3Xd ConstrainedSolid::forces(const NodeSolution& solution, Eigen::Index column) const {
    return gathered_reactions(shares_, n_constrained_, solution.loads.col(column)).forces;
}

double ConstrainedSolid::residual(const NodeSolution& solution, Control& control) const {
    return checks_.residual(solution, control);
}

std::shared_ptr<const InteriorField> ConstrainedSolid::interior_field(NodeSolution&& solution, Control& control) const {
    return checks_.interior_field(std::move(solution), control);
}

std::optional<SolutionError> ConstrainedSolid::error(const Eigen::VectorXd& values, const NodeSolution& solution,
                                                     Control& control) const {
    if (!checks_.reference) return {};
    Eigen::MatrixXd u = display_ ? Eigen::MatrixXd(*display_ * solution.displacements.col(0))
                                 : Eigen::MatrixXd(solution.displacements.col(0).head(3 * n_vertices_));
    add_particular(solution.factors, u);
    NodeSolution first = solution;
    if (display_ || !particular_.empty()) first.displacements = u;
    const std::optional<ReferenceAnswer> reference = checks_.reference(values, first, control);
    if (!reference) return {};
    const Reactions own = reactions(solution);
    return SolutionError{reference->share * (reference->displacements - u.col(0)),
                         {reference->share * (reference->reactions.forces - own.forces),
                          reference->share * (reference->reactions.moments - own.moments)},
                         reference->share > 0.0 ? 1.0 / reference->share : 0.0};
}

}  // namespace elastolab
