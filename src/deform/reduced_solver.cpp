#include "deform/reduced_solver.hpp"

#include <cassert>

#include "base/error.hpp"

namespace elastolab {

namespace {

/// Below this reciprocal condition the small system counts as rank-deficient; its usual value is above 1e-6.
constexpr double kSingular = 1e-13;
/// Relative size of what counts as zero when its rank is decided.
constexpr double kRankTolerance = 1e-10;

}  // namespace

void set_prescribed(const std::vector<int>& nodes, const Eigen::MatrixXd& prescribed, Eigen::MatrixXd& displacements) {
    for (std::size_t i = 0; i < nodes.size(); ++i)
        displacements.middleRows<3>(3 * nodes[i]) = prescribed.middleRows<3>(3 * static_cast<Eigen::Index>(i));
}

Eigen::MatrixXd border_columns(const std::vector<int>& nodes, const Eigen::MatrixXd& rigid) {
    const Eigen::Index n_border = rigid.cols();
    Eigen::MatrixXd columns(3 * std::ssize(nodes) + n_border, n_border);
    for (std::size_t i = 0; i < nodes.size(); ++i)
        columns.middleRows(3 * static_cast<Eigen::Index>(i), 3) = rigid.middleRows(3 * nodes[i], 3);
    columns.bottomRows(n_border) = rigid.bottomRows(n_border);
    return columns;
}

Eigen::MatrixXd KeptResponses::small_matrix(const std::vector<int>& nodes, const Eigen::MatrixXd& rigid,
                                            Control&) const {
    Eigen::MatrixXd S(3 * std::ssize(nodes) + rigid.cols(), cols() + rigid.cols());
    S.leftCols(cols()) = columns_.rows_of(nodes, rigid.rows() - rigid.cols());
    S.rightCols(rigid.cols()) = border_columns(nodes, rigid);
    return S;
}

ReducedSolver::ReducedSolver(ReducedSystem system, Control& control) : system_(std::move(system)) {
    Eigen::MatrixXd S = system_.responses->small_matrix(system_.nodes, system_.rigid, control);
    assert(S.rows() == S.cols());
    if (S.size() == 0) return;
    // Loads and border values have different units; dividing each column by its largest entry makes the condition
    // independent of them. The border has one scale for all its columns: where the body is not held, the smallest
    // border values are to mean the smallest motion.
    scale_ = S.cwiseAbs().colwise().maxCoeff().transpose();
    if (auto border = scale_.tail(system_.rigid.cols()); border.size() > 0) border.setConstant(border.maxCoeff());
    if (!scale_.allFinite()) throw SolveError("constrained system: has entries that are not finite. Check the mesh.");
    scale_ = (scale_.array() > 0.0).select(scale_, 1.0);
    S.array().rowwise() /= scale_.transpose().array();
    try {
        lu_ = LuFactorization(std::move(S), "constrained system", &control);
        condition_ = 1.0 / std::max(lu_.reciprocal_condition(), 1e-300);
    } catch (const SolveError&) {
        condition_ = 1e300;
    }
    if (condition_ * kSingular < 1.0) return;
    // Rare, and the system may be large: it is made again rather than copied every time.
    held_ = false;
    lu_ = LuFactorization();
    deficient_ = system_.responses->small_matrix(system_.nodes, system_.rigid, control);
    deficient_.array().rowwise() /= scale_.transpose().array();
}

Eigen::MatrixXd ReducedSolver::unknowns(const Eigen::MatrixXd& right) const {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(scale_.size(), right.cols());
    all.topRows(right.rows()) = right;
    Eigen::MatrixXd x = held_ ? lu_.solve(std::move(all)) : solve_minimum_norm(deficient_, all, kRankTolerance).X;
    x.array().colwise() /= scale_.array();
    if (!x.allFinite())
        throw SolveError("constrained system: its solution is not finite. Remove handles that nearly coincide.");
    return x;
}

Eigen::MatrixXd ReducedSolver::displacements(const Eigen::MatrixXd& unknowns, Control& control) const {
    const Eigen::Index n_border = system_.rigid.cols(), n_rows = system_.rigid.rows() - n_border;
    Eigen::MatrixXd u = system_.rigid.topRows(n_rows) * unknowns.bottomRows(n_border);
    system_.responses->add_product(unknowns.topRows(system_.responses->cols()), u, control);
    return u;
}

NodeSolution ReducedSolver::solve(const Eigen::MatrixXd& prescribed, bool want_loads) const {
    Control control;
    return solve_watched(prescribed, want_loads, kSolveTolerance, control);
}

NodeSolution ReducedSolver::solve_watched(const Eigen::MatrixXd& prescribed, bool want_loads, double,
                                          Control& control) const {
    control.checkpoint();
    assert(prescribed.rows() == 3 * std::ssize(system_.nodes));
    NodeSolution solution;
    if (scale_.size() == 0) {
        solution.displacements = Eigen::MatrixXd::Zero(system_.rigid.rows() - system_.rigid.cols(), prescribed.cols());
        solution.loads = Eigen::MatrixXd::Zero(system_.n_loads, prescribed.cols());
        return solution;
    }
    const Eigen::MatrixXd x = unknowns(prescribed);
    solution.displacements = displacements(x, control);
    set_prescribed(system_.nodes, prescribed, solution.displacements);
    if (want_loads) solution.loads = x.topRows(system_.n_loads);
    return solution;
}

}  // namespace elastolab
