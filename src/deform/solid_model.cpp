#include "deform/solid_model.hpp"

#include <cassert>
#include <Eigen/Geometry>

namespace elastolab {

ConstrainedSolid::ConstrainedSolid(int n_vertices, ConstrainedNodes nodes, std::vector<LoadShare> shares,
                                   std::shared_ptr<const SparseRows> display, std::unique_ptr<NodeSolver> solver,
                                   Residual residual)
    : n_vertices_(n_vertices),
      nodes_(std::move(nodes)),
      shares_(std::move(shares)),
      display_(std::move(display)),
      solver_(std::move(solver)),
      residual_(std::move(residual)) {}

Eigen::MatrixXd ConstrainedSolid::displace(const Eigen::MatrixXd& values) const {
    assert(values.rows() == nodes_.prescribe.cols());
    NodeSolution solution = solver_->solve(nodes_.prescribe * values, false);
    if (display_) return *display_ * solution.displacements;
    if (solution.displacements.rows() == 3 * n_vertices_) return std::move(solution.displacements);
    return solution.displacements.topRows(3 * n_vertices_);
}

Reactions ConstrainedSolid::reactions(const Eigen::VectorXd& values) const {
    const NodeSolution solution = solver_->solve(nodes_.prescribe * values, true);
    const Eigen::Index n = values.size() / 3;
    Reactions reactions{Eigen::Matrix3Xd::Zero(3, n), Eigen::Matrix3Xd::Zero(3, n)};
    for (const LoadShare& share : shares_) {
        const Eigen::Vector3d load = solution.loads.col(0).segment<3>(3 * share.slot);
        reactions.forces.col(share.constrained) += share.weight * load;
        reactions.moments.col(share.constrained) += share.first_moment.cross(load);
    }
    return reactions;
}

double ConstrainedSolid::residual(const Eigen::VectorXd& values, Control& control) const {
    return residual_(solver_->solve(nodes_.prescribe * values, true), control);
}

}  // namespace elastolab
