#include "base/refined_lu.hpp"

#include <lapacke.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/blas.hpp"
#include "base/blocked_lu.hpp"
#include "base/error.hpp"
#include "base/strips.hpp"

namespace elastolab {

namespace {

/// Below this condition number refinement gains at least two digits a step.
constexpr double kSafeReciprocalCondition = 1e-5;
constexpr int kMostSteps = 30;
/// Smallest matrix for which single precision pays.
constexpr Eigen::Index kWorthwhile = 256;

// Passes over the whole matrix, on all threads: beside a factorisation in single precision, a pass on one thread
// would take noticeable time.

/// Largest entry and largest column sum, of absolute values.
struct ColumnNorms {
    double entry = 0.0, sum = 0.0;
};
ColumnNorms column_norms(const Eigen::MatrixXd& A) {
    double entry = 0.0, sum = 0.0;
#pragma omp parallel for num_threads(thread_count()) reduction(max : entry, sum)
    for (Eigen::Index column = 0; column < A.cols(); ++column) {
        entry = std::max(entry, A.col(column).cwiseAbs().maxCoeff());
        sum = std::max(sum, A.col(column).cwiseAbs().sum());
    }
    return {entry, sum};
}

double largest_row_sum(const Eigen::MatrixXd& A) {
    constexpr Eigen::Index kRows = 256;
    double sum = 0.0;
#pragma omp parallel for num_threads(thread_count()) reduction(max : sum)
    for (Eigen::Index row = 0; row < A.rows(); row += kRows)
        sum = std::max(sum, A.middleRows(row, std::min(kRows, A.rows() - row)).cwiseAbs().rowwise().sum().maxCoeff());
    return sum;
}

Eigen::MatrixXf in_single_precision(const Eigen::MatrixXd& A) {
    Eigen::MatrixXf B(A.rows(), A.cols());
#pragma omp parallel for num_threads(thread_count())
    for (Eigen::Index column = 0; column < A.cols(); ++column) B.col(column) = A.col(column).cast<float>();
    return B;
}

}  // namespace

RefinedLu::RefinedLu(Eigen::MatrixXd&& A, std::string name, Control* control)
    : name_(std::move(name)), matrix_(std::move(A)) {
    const ColumnNorms norms = column_norms(matrix_);
    const bool fits = norms.entry < 1e30 && norms.entry > 1e-30;
    if (fits && matrix_.rows() >= kWorthwhile) factorise_single(norms.sum, control);
    if (reciprocal_condition_ < kSafeReciprocalCondition) {
        factors_.resize(0, 0);
        full_precision_ = LuFactorization(std::move(matrix_), name_, control);
        matrix_.resize(0, 0);
        reciprocal_condition_ = full_precision_.reciprocal_condition();
        return;
    }
    norm_ = largest_row_sum(matrix_);
}

void RefinedLu::factorise_single(double norm, Control* control) {
    const auto n = static_cast<int>(matrix_.rows());
    factors_ = in_single_precision(matrix_);
    if (factorise_lu(factors_, pivots_, control) != 0) return;
    std::vector<float> work(4 * static_cast<std::size_t>(n));
    std::vector<int> iwork(static_cast<std::size_t>(n));
    float reciprocal_condition = 0.0F;
    const SerialBlas serial;
    LAPACKE_sgecon_work(LAPACK_COL_MAJOR, '1', n, factors_.data(), n, static_cast<float>(norm), &reciprocal_condition,
                        work.data(), iwork.data());
    if (std::isfinite(reciprocal_condition)) reciprocal_condition_ = reciprocal_condition;
}

Eigen::MatrixXd RefinedLu::solve_single(const Eigen::MatrixXd& B) const {
    // Columns are scaled to 1, since small residuals would leave the range of single precision.
    Eigen::RowVectorXd scale = B.cwiseAbs().colwise().maxCoeff();
    scale = (scale.array() > 0.0).select(scale, 1.0);
    Eigen::MatrixXf X = (B.array().rowwise() / scale.array()).matrix().cast<float>();
    const auto n = static_cast<int>(B.rows());
    for_right_sides(B.cols(), [&](Eigen::Index first, Eigen::Index count) {
        LAPACKE_sgetrs_work(LAPACK_COL_MAJOR, 'N', n, static_cast<int>(count), factors_.data(), n, pivots_.data(),
                            X.data() + first * n, n);
    });
    return X.cast<double>().array().rowwise() * scale.array();
}

bool RefinedLu::refine(const Eigen::MatrixXd& B, Eigen::MatrixXd& X) const {
    // The residual that rounding in the product leaves; factors in double precision would leave as much.
    const double rounding = std::numeric_limits<double>::epsilon() * std::sqrt(static_cast<double>(B.rows())) * norm_;
    double before = std::numeric_limits<double>::infinity();
    for (int step = 0; step < kMostSteps; ++step) {
        Eigen::MatrixXd residual = B;
        residual.noalias() -= matrix_ * X;
        const Eigen::RowVectorXd off = residual.cwiseAbs().colwise().maxCoeff();
        const Eigen::RowVectorXd allowed = rounding * X.cwiseAbs().colwise().maxCoeff();
        const bool good = (off.array() <= allowed.array()).all();
        if (!good && !(off.maxCoeff() < 0.25 * before)) return false;
        X += solve_single(residual);
        if (good) return true;  // one step more than needed: it is cheap and improves small entries
        before = off.maxCoeff();
    }
    return false;
}

Eigen::MatrixXd RefinedLu::solve(const Eigen::MatrixXd& B) const {
    if (!is_single()) return full_precision_.solve(B);
    Eigen::MatrixXd X = solve_single(B);
    return refine(B, X) ? X : fallback().solve(B);
}

const LuFactorization& RefinedLu::fallback() const {
    const std::scoped_lock lock(fallback_->mutex);
    if (fallback_->lu.size() == 0) fallback_->lu = LuFactorization(Eigen::MatrixXd(matrix_), name_);
    return fallback_->lu;
}

}  // namespace elastolab
