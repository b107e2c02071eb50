#include "bem/galerkin/solvers.hpp"

#include <cmath>

#include "base/error.hpp"
#include "base/lapack.hpp"
#include "base/strips.hpp"

namespace elastolab {

GalerkinResponses::GalerkinResponses(std::shared_ptr<const GalerkinSystem> system, std::vector<int> vertices,
                                     GalerkinTractions tractions, Control& control)
    : system_(std::move(system)), vertices_(std::move(vertices)), tractions_(std::move(tractions)) {
    columns_ = system_->half_responses(vertices_, tractions_, control);
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

Eigen::MatrixXd GalerkinResponses::small_matrix(const std::vector<int>& nodes, const Eigen::MatrixXd& rigid,
                                                Control& control) const {
    const Eigen::Index n = system_->size(), m = columns_.cols(), n_border = rigid.cols();
    const Eigen::Index n_loads = 3 * std::ssize(nodes), n_tractions = m - n_loads;
    const Eigen::MatrixXd all = columns_.middle(0, m);
    const Eigen::MatrixXd F = all.bottomRows(n_border);
    Eigen::MatrixXd G = product_with_transpose(all.topRows(n));
    control.checkpoint();
    G.noalias() -= F.transpose() * (F / system_->shift());
    G.bottomRightCorner(n_tractions, n_tractions) += system_->single_layer(tractions_, control);
    // The rows of the border stand between those of the vertices and those of the tractions.
    Eigen::MatrixXd S = Eigen::MatrixXd::Zero(m + n_border, m + n_border);
    S.topLeftCorner(n_loads, m) = G.topRows(n_loads);
    S.block(n_loads, 0, n_border, m) = F;
    S.bottomLeftCorner(n_tractions, m) = G.bottomRows(n_tractions);
    S.topRightCorner(n_loads, n_border) = F.leftCols(n_loads).transpose();
    S.bottomRightCorner(n_tractions, n_border) = F.rightCols(n_tractions).transpose();
    // Rows of the border and of the tractions have units of their own: with lengths far from 1 some would look like
    // nothing beside others. Their right sides are zero, so that any factor will do: they are made as large as those of
    // the vertices.
    const auto scale_rows = [&](Eigen::Index first, Eigen::Index count) {
        const double own = count > 0 && n_loads > 0 ? S.block(first, 0, count, n_loads).cwiseAbs().maxCoeff() : 0.0;
        if (own > 0.0) S.middleRows(first, count) *= S.topLeftCorner(n_loads, n_loads).cwiseAbs().maxCoeff() / own;
    };
    scale_rows(n_loads, n_border);
    scale_rows(n_loads + n_border, n_tractions);
    return S;
}

void GalerkinResponses::add_product(const Eigen::MatrixXd& loads, Eigen::Ref<Eigen::MatrixXd> displacements,
                                    Control& control) const {
    control.checkpoint();
    const Eigen::Index n = system_->size();
    Eigen::MatrixXd product = Eigen::MatrixXd::Zero(n + system_->surfaces().rigid.cols(), loads.cols());
    columns_.add_product(loads, product);
    Eigen::MatrixXd u = product.topRows(n);
    system_->finish(u, product.bottomRows(product.rows() - n));
    displacements += u;
}

ReducedSystem galerkin_reduced_system(const std::shared_ptr<const GalerkinSystem>& system,
                                      const std::vector<int>& vertices, const GalerkinTractions& tractions,
                                      Control& control) {
    const Eigen::MatrixXd& C = system->surfaces().rigid;
    ReducedSystem reduced;
    reduced.responses = std::make_shared<const GalerkinResponses>(system, vertices, tractions, control);
    reduced.rigid = Eigen::MatrixXd::Zero(C.rows() + C.cols(), C.cols());
    reduced.rigid.topRows(C.rows()) = C;
    reduced.nodes = vertices;
    reduced.n_loads = 3 * std::ssize(vertices) + tractions.size();
    return reduced;
}

/// The hypersingular matrix and that of the free vertices, both layers.
std::uint64_t galerkin_direct_memory(std::int64_t n_unknowns, std::int64_t n_tractions) {
    const auto n = static_cast<std::uint64_t>(n_unknowns), m = static_cast<std::uint64_t>(n_tractions);
    return 8 * (2 * n * n + 3 * n * m + m * m);
}

GalerkinDirectSolver::GalerkinDirectSolver(const GalerkinSystem& system, const std::vector<int>& vertices,
                                           const GalerkinTractions& tractions, Control& control)
    : partition_(system.size(), vertices) {
    control.begin_stage("integrate");
    GalerkinOperators operators = system.operators(tractions, control);
    const Eigen::MatrixXd D = system.hypersingular(control);
    control.begin_stage("factorise");
    single_layer_ = CholeskyFactorization(std::move(operators.single_layer), "single-layer matrix", &control);
    Y_ = std::move(operators.double_layer);
    single_layer_.solve_lower_in_place(Y_);
    D_constrained_ = D(partition_.constrained, Eigen::all);
    Eigen::MatrixXd S = D(partition_.free, partition_.free);
    const Eigen::MatrixXd Y_free = Y_(Eigen::all, partition_.free);
    S.noalias() += Y_free.transpose() * Y_free;
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
    u = Eigen::MatrixXd::Zero(std::ssize(free) + std::ssize(constrained), prescribed.cols());
    u(constrained, Eigen::all) = prescribed;
    const Eigen::MatrixXd Y_u = Y_ * u;
    Eigen::MatrixXd right = -(D_constrained_.transpose() * prescribed);  // D is symmetric
    right.noalias() -= Y_.transpose() * Y_u;
    Eigen::MatrixXd x = right(free, Eigen::all);
    free_.solve_in_place(x);
    u(free, Eigen::all) = x;
    if (!want_loads) return solution;
    const Eigen::MatrixXd Y_all = Y_ * u;
    Eigen::MatrixXd t = Y_all;
    single_layer_.solve_upper_in_place(t);
    solution.loads.resize(std::ssize(constrained) + t.rows(), prescribed.cols());
    solution.loads.topRows(std::ssize(constrained)) =
        D_constrained_ * u + Y_(Eigen::all, constrained).transpose() * Y_all;
    solution.loads.bottomRows(t.rows()) = t;
    return solution;
}

double galerkin_residual(const GalerkinSystem& system, const std::vector<int>& vertices,
                         const GalerkinTractions& tractions, const NodeSolution& solution, Control& control) {
    const GalerkinOperators operators = system.operators(tractions, control);
    const Eigen::MatrixXd D = system.hypersingular(control);
    const Eigen::MatrixXd &K = operators.double_layer, &V = operators.single_layer;
    const Eigen::VectorXd u = solution.displacements.col(0), t = solution.loads.col(0).tail(tractions.size());
    Eigen::VectorXd off = D * u, size = D.cwiseAbs() * u.cwiseAbs();
    const auto ratio = [](const Eigen::VectorXd& part, const Eigen::VectorXd& whole) {
        return whole.norm() > 0.0 ? part.norm() / whole.norm() : 0.0;
    };
    // Both equations have units of their own, so each is judged by itself.
    double second = 0.0;
    if (t.size() > 0) {  // without a constrained triangle there is no second; the BLAS complains of empty matrices
        off += K.transpose() * t;
        size += K.cwiseAbs().transpose() * t.cwiseAbs();
        second = ratio(K * u - V * t, K.cwiseAbs() * u.cwiseAbs() + V.cwiseAbs() * t.cwiseAbs());
    }
    for (std::size_t i = 0; i < vertices.size(); ++i)
        off.segment<3>(3 * vertices[i]) -= solution.loads.col(0).segment<3>(3 * static_cast<Eigen::Index>(i));
    const double first = ratio(off, size);
    return std::max(first, second);
}

}  // namespace elastolab
