#include "deform/reduced_solver.hpp"

#include <cassert>

#include "base/error.hpp"
#include "deform/node_rows.hpp"

namespace elastolab {

namespace {

/// Below this reciprocal condition the capacitance system counts as rank-deficient; its usual value is above 1e-6.
constexpr double kSingular = 1e-13;
/// Relative size of what counts as zero when its rank is decided.
constexpr double kRankTolerance = 1e-10;

}  // namespace

void set_prescribed(const std::vector<int>& nodes, const Eigen::MatrixXd& prescribed, Eigen::MatrixXd& displacements) {
    put_rows(prescribed, nodes, displacements);
}

Eigen::MatrixXd border_columns(const std::vector<int>& nodes, const Eigen::MatrixXd& rigid) {
    const Eigen::Index n_border = rigid.cols();
    Eigen::MatrixXd columns(3 * std::ssize(nodes) + n_border, n_border);
    columns.topRows(3 * std::ssize(nodes)) = rows_of(rigid, nodes);
    columns.bottomRows(n_border) = rigid.bottomRows(n_border);
    return columns;
}

Eigen::MatrixXd KeptComplianceColumns::capacitance_matrix(const std::vector<int>& nodes, const Eigen::MatrixXd& rigid,
                                                          Control&) const {
    const Eigen::Index n_border = rigid.cols(), border = rigid.rows() - n_border;
    Eigen::MatrixXd S(3 * std::ssize(nodes) + n_border, cols() + n_border + n_given());
    if (cols() > 0) S.leftCols(cols()) = columns_.rows_of(nodes, border);
    S.middleCols(cols(), n_border) = border_columns(nodes, rigid);
    if (n_given() > 0) S.rightCols(n_given()) = given_.rows_of(nodes, border);
    return S;
}

Eigen::MatrixXd ReducedSolver::scaled_matrix(Control& control) {
    Eigen::MatrixXd S = system_.compliance_columns->capacitance_matrix(system_.nodes, system_.rigid, control);
    const Eigen::Index n_given = system_.compliance_columns->n_given();
    assert(S.rows() == S.cols() - n_given);
    given_ = S.rightCols(n_given);
    S.conservativeResize(Eigen::NoChange, S.rows());
    if (S.size() == 0) return S;
    // Loads and border values have different units; dividing each column by its largest entry makes the condition
    // independent of them. The border has one scale for all its columns: where the body is not held, the smallest
    // border values are to mean the smallest motion.
    scale_ = S.cwiseAbs().colwise().maxCoeff().transpose();
    if (auto border = scale_.tail(system_.rigid.cols()); border.size() > 0) border.setConstant(border.maxCoeff());
    if (!scale_.allFinite() || !given_.allFinite())
        throw SolveError("constrained system: has entries that are not finite. Check the mesh.");
    scale_ = (scale_.array() > 0.0).select(scale_, 1.0);
    S.array().rowwise() /= scale_.transpose().array();
    return S;
}

ReducedSolver::ReducedSolver(ReducedSystem system, Control& control) : system_(std::move(system)) {
    if (system_.nodes.empty() && system_.compliance_columns->cols() == 0) {
        // Loads on a free body: the border values are what they lack of balance, which is rounding or, with
        // collocation, the error of the discretisation. J is rounding, too, and must not divide it.
        held_ = system_.rigid.cols() == 0;
        return;
    }
    Eigen::MatrixXd S = scaled_matrix(control);
    if (S.size() == 0) return;
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
    deficient_ = scaled_matrix(control);
}

Eigen::MatrixXd ReducedSolver::unknowns(Eigen::MatrixXd right) const {
    Eigen::MatrixXd x = held_ ? lu_.solve(std::move(right)) : solve_minimum_norm(deficient_, right, kRankTolerance).X;
    x.array().colwise() /= scale_.array();
    if (!x.allFinite())
        throw SolveError("constrained system: its solution is not finite. Remove handles that nearly coincide.");
    return x;
}

Eigen::MatrixXd ReducedSolver::displacements(const Eigen::MatrixXd& unknowns, const Eigen::MatrixXd& factors,
                                             Control& control) const {
    const Eigen::Index n_border = system_.rigid.cols(), n_rows = system_.rigid.rows() - n_border;
    Eigen::MatrixXd u = system_.rigid.topRows(n_rows) * unknowns.bottomRows(n_border);
    const Eigen::Index n_unknown = system_.compliance_columns->cols();
    if (factors.rows() == 0) {
        system_.compliance_columns->add_product(unknowns.topRows(n_unknown), u, control);
        return u;
    }
    Eigen::MatrixXd loads(n_unknown + factors.rows(), unknowns.cols());
    loads << unknowns.topRows(n_unknown), factors;
    system_.compliance_columns->add_product(loads, u, control);
    return u;
}

NodeSolution ReducedSolver::solve(const Eigen::MatrixXd& prescribed, bool want_loads) const {
    Control control;
    return solve_watched(prescribed, want_loads, kSolveTolerance, control);
}

NodeSolution ReducedSolver::solve_watched(const Eigen::MatrixXd& prescribed, bool want_loads, double,
                                          Control& control) const {
    control.checkpoint();
    const Eigen::Index n = 3 * std::ssize(system_.nodes), n_given = system_.compliance_columns->n_given();
    assert(prescribed.rows() == n + n_given);
    NodeSolution solution;
    Eigen::MatrixXd x =
        Eigen::MatrixXd::Zero(system_.compliance_columns->cols() + system_.rigid.cols(), prescribed.cols());
    if (scale_.size() > 0) {
        Eigen::MatrixXd right = Eigen::MatrixXd::Zero(scale_.size(), prescribed.cols());
        right.topRows(n) = prescribed.topRows(n);
        if (n_given > 0) right.noalias() -= given_ * prescribed.bottomRows(n_given);
        x = unknowns(std::move(right));
    }
    solution.displacements = displacements(x, prescribed.bottomRows(n_given), control);
    set_prescribed(system_.nodes, prescribed, solution.displacements);
    if (want_loads) solution.loads = x.topRows(system_.n_loads);
    return solution;
}

}  // namespace elastolab
