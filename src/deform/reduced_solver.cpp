#include "deform/reduced_solver.hpp"

#include <cassert>

#include "base/error.hpp"

namespace elastolab {

namespace {

/// Below this reciprocal condition the small system counts as rank-deficient; its usual value is above 1e-6.
constexpr double kSingular = 1e-13;
/// Relative size of what counts as zero when its rank is decided.
constexpr double kRankTolerance = 1e-10;

Eigen::MatrixXd small_matrix(const ReducedSystem& system) {
    const Eigen::Index n_border = system.rigid.cols(), n_nodes = system.rigid.rows() - n_border;
    const Eigen::Index q = system.columns.cols(), p = system.closing.rows(), k = 3 * std::ssize(system.nodes);
    Eigen::MatrixXd S(k + n_border + p, q + n_border);
    assert(S.rows() == S.cols());
    S.topLeftCorner(k + n_border, q) = system.columns.rows_of(system.nodes, n_nodes);
    for (std::size_t i = 0; i < system.nodes.size(); ++i)
        S.block(3 * static_cast<Eigen::Index>(i), q, 3, n_border) = system.rigid.middleRows(3 * system.nodes[i], 3);
    S.block(k, q, n_border, n_border) = system.rigid.bottomRows(n_border);
    if (p > 0) S.bottomRows(p) = system.closing;
    return S;
}

}  // namespace

void set_prescribed(const std::vector<int>& nodes, const Eigen::MatrixXd& prescribed, Eigen::MatrixXd& displacements) {
    for (std::size_t i = 0; i < nodes.size(); ++i)
        displacements.middleRows<3>(3 * nodes[i]) = prescribed.middleRows<3>(3 * static_cast<Eigen::Index>(i));
}

ReducedSolver::ReducedSolver(ReducedSystem system) : system_(std::move(system)) {
    Eigen::MatrixXd S = small_matrix(system_);
    system_.closing.resize(0, 0);
    if (S.size() == 0) return;
    // Loads and border values have different units; dividing each column by its largest entry makes the condition
    // independent of them. The border has one scale for all its columns: where the body is not held, the smallest
    // border values are to mean the smallest motion.
    scale_ = S.cwiseAbs().colwise().maxCoeff().transpose();
    if (auto border = scale_.tail(system_.rigid.cols()); border.size() > 0) border.setConstant(border.maxCoeff());
    if (!scale_.allFinite()) throw SolveError("constrained system: has entries that are not finite. Check the mesh.");
    scale_ = (scale_.array() > 0.0).select(scale_, 1.0);
    S.array().rowwise() /= scale_.transpose().array();
    Eigen::MatrixXd copy = S;
    try {
        lu_ = LuFactorization(std::move(S), "constrained system");
        condition_ = 1.0 / std::max(lu_.reciprocal_condition(), 1e-300);
    } catch (const SolveError&) {
        condition_ = 1e300;
    }
    if (condition_ * kSingular < 1.0) return;
    held_ = false;
    deficient_ = std::move(copy);
}

Eigen::MatrixXd ReducedSolver::unknowns(const Eigen::MatrixXd& prescribed) const {
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(scale_.size(), prescribed.cols());
    right.topRows(prescribed.rows()) = prescribed;
    Eigen::MatrixXd x = held_ ? lu_.solve(std::move(right)) : solve_minimum_norm(deficient_, right, kRankTolerance).X;
    x.array().colwise() /= scale_.array();
    return x;
}

NodeSolution ReducedSolver::solve(const Eigen::MatrixXd& prescribed, bool want_loads) const {
    assert(prescribed.rows() == 3 * std::ssize(system_.nodes));
    const Eigen::Index n_border = system_.rigid.cols(), n_rows = system_.rigid.rows() - n_border;
    NodeSolution solution;
    solution.displacements = Eigen::MatrixXd::Zero(n_rows, prescribed.cols());
    if (scale_.size() == 0) {
        solution.loads = Eigen::MatrixXd::Zero(system_.n_loads, prescribed.cols());
        return solution;
    }
    const Eigen::MatrixXd x = unknowns(prescribed);
    if (!x.allFinite())
        throw SolveError("constrained system: its solution is not finite. Remove handles that nearly coincide.");
    system_.columns.add_product(x.topRows(system_.columns.cols()), solution.displacements);
    solution.displacements.noalias() += system_.rigid.topRows(n_rows) * x.bottomRows(n_border);
    set_prescribed(system_.nodes, prescribed, solution.displacements);
    if (want_loads) solution.loads = x.topRows(system_.n_loads);
    return solution;
}

}  // namespace elastolab
