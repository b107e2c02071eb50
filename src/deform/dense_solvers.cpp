#include "deform/dense_solvers.hpp"

#include "base/error.hpp"

namespace elastolab {

namespace {

double condition_of(const LuFactorization& lu) { return lu.size() > 0 ? 1.0 / lu.reciprocal_condition() : 1.0; }

/// The equations of one constrained set: prescribed displacements U1 over the factors of the given loads.
struct Setting {
    const DenseOperators& operators;
    const Partition& partition;
    const Eigen::MatrixXd& given;

    Eigen::MatrixXd U1(const Eigen::MatrixXd& prescribed) const {
        return prescribed.topRows(prescribed.rows() - given.cols());
    }
    /// The given loads, at all nodes.
    Eigen::MatrixXd loads(const Eigen::MatrixXd& prescribed) const {
        return given * prescribed.bottomRows(given.cols());
    }
    /// G0 - K01 U1
    Eigen::MatrixXd right_side(const Eigen::MatrixXd& prescribed) const {
        const Eigen::MatrixXd K01 = operators.K(partition.free, partition.constrained);
        Eigen::MatrixXd right = -(K01 * U1(prescribed));
        if (given.cols() > 0) right += loads(prescribed)(partition.free, Eigen::all);
        return right;
    }
    /// U from its two parts, and T1 = K10 U0 + K11 U1 - G1.
    NodeSolution assemble(const Eigen::MatrixXd& U0, const Eigen::MatrixXd& prescribed, bool want_loads) const {
        NodeSolution solution;
        solution.displacements.resize(operators.K.rows(), prescribed.cols());
        solution.displacements(partition.free, Eigen::all) = U0;
        solution.displacements(partition.constrained, Eigen::all) = U1(prescribed);
        if (!want_loads) return solution;
        const Eigen::MatrixXd K1 = operators.K(partition.constrained, Eigen::all);
        solution.loads = K1 * solution.displacements;
        if (given.cols() > 0) solution.loads -= loads(prescribed)(partition.constrained, Eigen::all);
        return solution;
    }
};

}  // namespace

Partition::Partition(Eigen::Index n_dofs, const std::vector<int>& nodes) {
    std::vector<char> is_constrained(static_cast<std::size_t>(n_dofs), 0);
    for (const int node : nodes)
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
            constrained.push_back(3 * node + axis);
            is_constrained[static_cast<std::size_t>(3 * node + axis)] = 1;
        }
    for (Eigen::Index dof = 0; dof < n_dofs; ++dof)
        if (!is_constrained[static_cast<std::size_t>(dof)]) free.push_back(dof);
}

Eigen::MatrixXd inverse_by_eqn9(const Eigen::MatrixXd& bordered_inverse, const Partition& partition) {
    std::vector<Eigen::Index> rest = partition.constrained;
    const auto n_dofs = static_cast<Eigen::Index>(partition.free.size() + partition.constrained.size());
    for (Eigen::Index border = n_dofs; border < bordered_inverse.rows(); ++border) rest.push_back(border);
    const LuFactorization D11 = factorise_held<LuFactorization>(bordered_inverse(rest, rest), "D11 of Eqn. 9");
    const Eigen::MatrixXd D10 = bordered_inverse(rest, partition.free), D01 = bordered_inverse(partition.free, rest);
    Eigen::MatrixXd K00_inverse = bordered_inverse(partition.free, partition.free);
    K00_inverse.noalias() -= D01 * D11.solve(D10);
    return K00_inverse;
}

DirectSolver::DirectSolver(std::shared_ptr<const DenseOperators> operators, const std::vector<int>& nodes,
                           Eigen::MatrixXd given, Control* control)
    : operators_(std::move(operators)),
      partition_(operators_->K.rows(), nodes),
      given_(std::move(given)),
      K00_(factorise_held<LuFactorization>(operators_->K(partition_.free, partition_.free), "K00", control)) {
    condition_ = condition_of(K00_);
}

NodeSolution DirectSolver::solve(const Eigen::MatrixXd& prescribed, bool want_loads) const {
    const Setting setting{*operators_, partition_, given_};
    return setting.assemble(K00_.solve(setting.right_side(prescribed)), prescribed, want_loads);
}

Eqn9Solver::Eqn9Solver(std::shared_ptr<const DenseOperators> operators, const std::vector<int>& nodes,
                       Eigen::MatrixXd given)
    : operators_(std::move(operators)),
      partition_(operators_->K.rows(), nodes),
      given_(std::move(given)),
      K00_inverse_(inverse_by_eqn9(operators_->Khatinv, partition_)) {}

NodeSolution Eqn9Solver::solve(const Eigen::MatrixXd& prescribed, bool want_loads) const {
    const Setting setting{*operators_, partition_, given_};
    return setting.assemble(K00_inverse_ * setting.right_side(prescribed), prescribed, want_loads);
}

std::unique_ptr<NodeSolver> make_paper_solver(std::shared_ptr<const DenseOperators> operators,
                                              const std::vector<int>& nodes, Eigen::MatrixXd given, Control& control) {
    if (6 * std::ssize(nodes) < operators->K.rows())
        return std::make_unique<Eqn9Solver>(std::move(operators), nodes, std::move(given));
    return std::make_unique<DirectSolver>(std::move(operators), nodes, std::move(given), &control);
}

}  // namespace elastolab
