#include "bem/galerkin/solvers.hpp"

#include <cmath>

#include "base/error.hpp"
#include "base/lapack.hpp"
#include "base/strips.hpp"

namespace elastolab {

GalerkinComplianceColumns::GalerkinComplianceColumns(std::shared_ptr<const GalerkinSystem> system,
                                                     std::vector<int> vertices, GalerkinTractions tractions,
                                                     std::span<const UnitLoad> loads, Control& control)
    : system_(std::move(system)),
      vertices_(std::move(vertices)),
      tractions_(std::move(tractions)),
      loads_(loads.begin(), loads.end()) {
    system_->factorise(control);
    columns_ = system_->half_columns(vertices_, tractions_, control);
    given_ = system_->half_load_columns(loads_, control);
}

namespace {

/// A^T A: what is above the diagonal, strip by strip, and its mirror image.
Eigen::MatrixXd product_with_transpose(const Eigen::Ref<const Eigen::MatrixXd>& A) {
    Eigen::MatrixXd P(A.cols(), A.cols());
    for_strips(A.cols(), [&](Eigen::Index first, Eigen::Index count) {
        const Eigen::Index end = first + count;
        P.block(0, first, end, count).noalias() = A.leftCols(end).transpose() * A.middleCols(first, count);
    });
    P.triangularView<Eigen::StrictlyLower>() = P.transpose();
    return P;
}

}  // namespace

Eigen::MatrixXd GalerkinComplianceColumns::capacitance_matrix(const std::vector<int>& nodes,
                                                              const Eigen::MatrixXd& rigid, Control& control) const {
    const Eigen::Index n = system_->size(), m = columns_.cols(), n_border = rigid.cols();
    const Eigen::Index n_loads = 3 * std::ssize(nodes), n_tractions = m - n_loads;
    const Eigen::MatrixXd all = columns_.middle(0, m);
    const Eigen::MatrixXd F = all.bottomRows(n_border);
    Eigen::MatrixXd G = product_with_transpose(all.topRows(n));
    control.checkpoint();
    G.noalias() -= F.transpose() * (F / system_->shift());
    G.bottomRightCorner(n_tractions, n_tractions) += system_->single_layer(tractions_, control);
    // The rows of the border stand between those of the vertices and those of the tractions.
    Eigen::MatrixXd S = Eigen::MatrixXd::Zero(m + n_border, m + n_border + n_given());
    S.topLeftCorner(n_loads, m) = G.topRows(n_loads);
    S.block(n_loads, 0, n_border, m) = F;
    S.bottomLeftCorner(n_tractions, m) = G.bottomRows(n_tractions);
    S.block(0, m, n_loads, n_border) = F.leftCols(n_loads).transpose();
    S.block(n_loads + n_border, m, n_tractions, n_border) = F.rightCols(n_tractions).transpose();
    if (n_given() > 0) {
        const Eigen::MatrixXd given = given_.middle(0, n_given()), F_given = given.bottomRows(n_border);
        Eigen::MatrixXd rows = all.topRows(n).transpose() * given.topRows(n);
        rows.noalias() -= F.transpose() * (F_given / system_->shift());
        rows.bottomRows(n_tractions) += system_->given_single_layer(tractions_, loads_, control);
        S.topRightCorner(n_loads, n_given()) = rows.topRows(n_loads);
        S.block(n_loads, m + n_border, n_border, n_given()) = F_given;
        S.bottomRightCorner(n_tractions, n_given()) = rows.bottomRows(n_tractions);
    }
    // Rows of the border and of the tractions have units of their own: with lengths far from 1 some would look like
    // nothing beside others. Nothing but the columns of the given loads is on their right sides, so that any factor
    // will do: they are made as large as those of the vertices.
    const auto scale_rows = [&](Eigen::Index first, Eigen::Index count) {
        const double own = count > 0 && n_loads > 0 ? S.block(first, 0, count, n_loads).cwiseAbs().maxCoeff() : 0.0;
        if (own > 0.0) S.middleRows(first, count) *= S.topLeftCorner(n_loads, n_loads).cwiseAbs().maxCoeff() / own;
    };
    scale_rows(n_loads, n_border);
    scale_rows(n_loads + n_border, n_tractions);
    return S;
}

void GalerkinComplianceColumns::add_product(const Eigen::MatrixXd& loads, Eigen::Ref<Eigen::MatrixXd> displacements,
                                            Control& control) const {
    control.checkpoint();
    const Eigen::Index n = system_->size();
    Eigen::MatrixXd product = Eigen::MatrixXd::Zero(n + system_->surfaces().rigid.cols(), loads.cols());
    columns_.add_product(loads.topRows(cols()), product);
    given_.add_product(loads.bottomRows(n_given()), product);
    Eigen::MatrixXd u = product.topRows(n);
    system_->finish(u, product.bottomRows(product.rows() - n));
    displacements += u;
}

ReducedSystem galerkin_reduced_system(const std::shared_ptr<const GalerkinSystem>& system,
                                      const std::vector<int>& vertices, const GalerkinTractions& tractions,
                                      std::span<const UnitLoad> loads, Control& control) {
    const Eigen::MatrixXd& C = system->surfaces().rigid;
    ReducedSystem reduced;
    reduced.compliance_columns =
        std::make_shared<const GalerkinComplianceColumns>(system, vertices, tractions, loads, control);
    reduced.rigid = Eigen::MatrixXd::Zero(C.rows() + C.cols(), C.cols());
    reduced.rigid.topRows(C.rows()) = C;
    reduced.nodes = vertices;
    reduced.n_loads = 3 * std::ssize(vertices) + tractions.size();
    return reduced;
}

/// The hypersingular matrix and that of the free vertices, both layers.
std::uint64_t galerkin_direct_memory(std::int64_t n_degrees_of_freedom, std::int64_t n_tractions) {
    const auto n = static_cast<std::uint64_t>(n_degrees_of_freedom), m = static_cast<std::uint64_t>(n_tractions);
    return 8 * (2 * n * n + 3 * n * m + m * m);
}

bool is_sooner_alone(std::int64_t n_degrees_of_freedom, std::int64_t n_prescribed, std::int64_t n_tractions) {
    const auto n = static_cast<double>(n_degrees_of_freedom), t = static_cast<double>(n_tractions);
    const double prescribed = static_cast<double>(n_prescribed), m = prescribed + t, free = n - prescribed;
    const double alone = n * t * t + t * t * t / 3.0 + free * free * t + free * free * free / 3.0;
    const double columns = n * n * n / 3.0 + n * n * m + n * m * m + m * m * m / 1.5;
    return alone < columns / 1.5;
}

GalerkinDirectSolver::GalerkinDirectSolver(const GalerkinSystem& system, const Eigen::MatrixXd& D,
                                           const std::vector<int>& vertices, const GalerkinTractions& tractions,
                                           std::span<const UnitLoad> loads, Control& control)
    : partition_(system.size(), vertices) {
    control.begin_stage("integrate");
    if (!loads.empty()) {
        given_forces_ = system.given_nodal_forces(loads, control);
        given_ = system.given_single_layer(tractions, loads, control);
    }
    GalerkinOperators operators = system.operators(tractions, control);
    control.begin_stage("factorise");
    single_layer_ = CholeskyFactorization(std::move(operators.single_layer), "single-layer matrix", &control);
    Y_ = std::move(operators.double_layer);
    single_layer_.solve_lower_in_place(Y_);
    if (given_.size() > 0) single_layer_.solve_lower_in_place(given_);
    D_constrained_ = D(partition_.constrained, Eigen::all);
    const Eigen::Map<const Eigen::Vector<Eigen::Index, Eigen::Dynamic>> free(partition_.free.data(),
                                                                             std::ssize(partition_.free));
    Eigen::MatrixXd S(free.size(), free.size()), Y_free(Y_.rows(), free.size());
    for_strips(free.size(), [&](Eigen::Index first, Eigen::Index count) {
        Y_free.middleCols(first, count) = Y_(Eigen::all, free.segment(first, count));
    });
    for_strips(free.size(), [&](Eigen::Index first, Eigen::Index count) {  // what is below the diagonal is enough
        const Eigen::Index n = free.size() - first;
        auto below = S.block(first, first, n, count);
        below = D(free.tail(n), free.segment(first, count));
        below.noalias() += Y_free.rightCols(n).transpose() * Y_free.middleCols(first, count);
    });
    constexpr double kSingular = 1e-14;
    try {
        free_ = CholeskyFactorization(std::move(S), "Galerkin matrix of the free vertices", &control);
    } catch (const SingularMatrixError&) {
        throw NotHeldError();
    }
    if (free_.reciprocal_condition() < kSingular) throw NotHeldError();
    condition_ = 1.0 / free_.reciprocal_condition();
}

NodeSolution GalerkinDirectSolver::solve(const Eigen::MatrixXd& prescribed, bool want_loads) const {
    const auto& [free, constrained] = partition_;
    NodeSolution solution;
    Eigen::MatrixXd& u = solution.displacements;
    const Eigen::Index n_constrained = std::ssize(constrained);
    const Eigen::MatrixXd factors = prescribed.bottomRows(prescribed.rows() - n_constrained);
    u = Eigen::MatrixXd::Zero(std::ssize(free) + n_constrained, prescribed.cols());
    u(constrained, Eigen::all) = prescribed.topRows(n_constrained);
    // Y u - L_V^-1 V g = L_V^T t
    const auto half_tractions = [&](const Eigen::MatrixXd& of_u) {
        Eigen::MatrixXd half = Y_ * of_u;
        if (given_.size() > 0) half.noalias() -= given_ * factors;
        return half;
    };
    Eigen::MatrixXd right = -(D_constrained_.transpose() * prescribed.topRows(n_constrained));  // D is symmetric
    right.noalias() -= Y_.transpose() * half_tractions(u);
    if (factors.rows() > 0) right.noalias() += given_forces_ * factors;
    Eigen::MatrixXd x = right(free, Eigen::all);
    free_.solve_in_place(x);
    u(free, Eigen::all) = x;
    if (!want_loads) return solution;
    const Eigen::MatrixXd half = half_tractions(u);
    Eigen::MatrixXd t = half;
    single_layer_.solve_upper_in_place(t);
    solution.loads.resize(n_constrained + t.rows(), prescribed.cols());
    solution.loads.topRows(n_constrained) = D_constrained_ * u + Y_(Eigen::all, constrained).transpose() * half;
    if (factors.rows() > 0) solution.loads.topRows(n_constrained) -= given_forces_(constrained, Eigen::all) * factors;
    solution.loads.bottomRows(t.rows()) = t;
    return solution;
}

}  // namespace elastolab
