#include "petsc/node_solvers.hpp"

#include <Eigen/QR>

#include "deform/holds.hpp"
#include "elasticity/rigid_motion.hpp"

namespace elastolab {

namespace {

/// Bordered responses of a free body to nodal forces: displacements of all nodes, whose surface moves by no rigid
/// motion, over what the forces lack of balance (docs/formulation.md section 2, on all nodes).
class FreeResponses {
public:
    FreeResponses(const PetscStiffness& stiffness, const Positions& positions, int n_surface)
        : stiffness_(stiffness), on_surface_(rigid_modes(positions.leftCols(n_surface))) {
        const Eigen::MatrixXd all = rigid_modes(positions);
        motions_ = all * all.topRows(on_surface_.rows()).householderQr().solve(on_surface_);
    }
    /// Rigid motions of all nodes that are orthonormal on the surface.
    const Eigen::MatrixXd& motions() const { return motions_; }

    Eigen::MatrixXd to(const Eigen::MatrixXd& forces, Control& control) const {
        const Eigen::Index n = on_surface_.rows();
        const Eigen::MatrixXd lacking = motions_.transpose() * forces;
        Eigen::MatrixXd balanced = forces;
        balanced.topRows(n).noalias() -= on_surface_ * lacking;
        Eigen::MatrixXd u = stiffness_.solve(balanced, kPetscTolerance, control);
        u -= motions_ * (on_surface_.transpose() * u.topRows(n)).eval();
        Eigen::MatrixXd response(u.rows() + lacking.rows(), u.cols());
        response << u, lacking;
        return response;
    }

private:
    const PetscStiffness& stiffness_;
    Eigen::MatrixXd on_surface_, motions_;
};

Columns as_columns(Eigen::MatrixXd matrix) {
    if (matrix.cols() == 0) return {};
    return Columns({std::make_shared<const Eigen::MatrixXd>(std::move(matrix))});
}

}  // namespace

PetscHeldSolver::PetscHeldSolver(std::shared_ptr<PetscStiffness> stiffness, const Positions& positions,
                                 std::vector<int> nodes, Eigen::MatrixXd given, Control& control)
    : stiffness_(std::move(stiffness)), nodes_(std::move(nodes)), given_(std::move(given)) {
    if (!holds(positions, nodes_)) throw NotHeldError();
    condition_ = stiffness_->eliminate(nodes_, control);
}

NodeSolution PetscHeldSolver::solve(const Eigen::MatrixXd& prescribed, bool want_loads) const {
    Control control;
    return solve_watched(prescribed, want_loads, kPetscTolerance, control);
}

NodeSolution PetscHeldSolver::solve_watched(const Eigen::MatrixXd& prescribed, bool want_loads, double /*tolerance*/,
                                            Control& control) const {
    stiffness_->ensure_eliminated(nodes_, control);
    NodeSolution solution;
    const Eigen::MatrixXd given = given_ * prescribed.bottomRows(given_.cols());
    solution.displacements = Eigen::MatrixXd::Zero(stiffness_->size(), prescribed.cols());
    set_prescribed(nodes_, prescribed, solution.displacements);
    Eigen::MatrixXd right = given - stiffness_->multiply(solution.displacements, control);
    for (const int node : nodes_) right.middleRows<3>(3 * node).setZero();
    solution.displacements += stiffness_->solve(right, kPetscTolerance, control);
    if (!want_loads) return solution;
    const Eigen::MatrixXd forces = stiffness_->multiply(solution.displacements, control) - given;
    solution.loads.resize(3 * std::ssize(nodes_), prescribed.cols());
    for (std::size_t i = 0; i < nodes_.size(); ++i)
        solution.loads.middleRows<3>(3 * static_cast<Eigen::Index>(i)) = forces.middleRows<3>(3 * nodes_[i]);
    return solution;
}

PetscFreeSolver::PetscFreeSolver(PetscStiffness& stiffness, const Positions& positions, int n_surface,
                                 const std::vector<int>& nodes, const Eigen::MatrixXd& given, Control& control) {
    const double of_grounded = stiffness.ground(choose_support(positions, n_surface), control);
    const FreeResponses responses(stiffness, positions, n_surface);
    Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(stiffness.size(), 3 * std::ssize(nodes));
    for (std::size_t i = 0; i < nodes.size(); ++i)
        unit.block<3, 3>(3 * nodes[i], 3 * static_cast<Eigen::Index>(i)).setIdentity();
    ReducedSystem reduced;
    reduced.responses = std::make_shared<const KeptResponses>(as_columns(responses.to(unit, control)),
                                                              as_columns(responses.to(given, control)));
    const Eigen::Index n_motions = responses.motions().cols();
    reduced.rigid = Eigen::MatrixXd::Zero(stiffness.size() + n_motions, n_motions);
    reduced.rigid.topRows(stiffness.size()) = responses.motions();
    reduced.nodes = nodes;
    reduced.n_loads = unit.cols();
    reduced_ = std::make_unique<const ReducedSolver>(std::move(reduced), control);
    condition_ = std::max(reduced_->condition(), of_grounded);
    held_ = reduced_->held();
}

double petsc_residual(const PetscStiffness& K, const Eigen::MatrixXd& u, const std::vector<int>& nodes,
                      const Eigen::MatrixXd& forces, const Eigen::MatrixXd& given, Control& control) {
    Eigen::MatrixXd f = Eigen::MatrixXd::Zero(u.rows(), 1);
    set_prescribed(nodes, forces, f);
    const double size = (K.multiply_sizes(u, control) + f.cwiseAbs() + given.cwiseAbs()).norm();
    return size > 0.0 ? (K.multiply(u, control) - f - given).norm() / size : 0.0;
}

}  // namespace elastolab
