#include "base/cholesky.hpp"

#include <cblas.h>
#include <lapacke.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "base/blas.hpp"
#include "base/error.hpp"
#include "base/lapack.hpp"
#include "base/strips.hpp"

namespace elastolab {

namespace {

/// Columns factorised between two checkpoints, by all threads or by one.
constexpr int kCholeskyBlock = 768, kCholeskyBlockInStrips = 128;
/// Rows up to which the BLAS is called on one thread for a part of the matrix each (for_strips).
constexpr int kLargestInStrips = 4096;

/// The largest column sum of the symmetric matrix whose lower triangle is given; NaN where an entry is not finite.
double norm_of(const Eigen::MatrixXd& A) {
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(A.cols());
    for (Eigen::Index j = 0; j < A.cols(); ++j) {
        const Eigen::Index below = A.rows() - j - 1;
        const auto column = A.col(j).tail(below).cwiseAbs();
        sums[j] += std::abs(A(j, j)) + column.sum();
        sums.tail(below) += column;
    }
    return sums.allFinite() ? sums.maxCoeff() : std::numeric_limits<double>::quiet_NaN();
}

void update_at_once(int rest, int size, const double* corner, double* below, double* next, int n) {
    cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, rest, size, 1.0, corner, n, below, n);
    cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, rest, size, -1.0, below, n, 1.0, next, n);
}

/// Strips of rows of the block below the corner, then strips of columns of what is left, each down from its diagonal.
void update_in_strips(int rest, int size, const double* corner, double* below, double* next, int n) {
    for_strips(rest, [&](Eigen::Index first, Eigen::Index count) {
        cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, static_cast<int>(count), size, 1.0,
                    corner, n, below + first, n);
    });
    for_strips(rest, std::min<Eigen::Index>(strip_width(rest), 192), [&](Eigen::Index first, Eigen::Index count) {
        const auto columns = static_cast<int>(count), under = rest - static_cast<int>(first) - columns;
        double* const diagonal = next + first * n + first;
        cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, columns, size, -1.0, below + first, n, 1.0, diagonal, n);
        if (under > 0)
            cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, under, columns, size, -1.0, below + first + count, n,
                        below + first, n, 1.0, diagonal + count, n);
    });
}

/// Right-looking, by block columns: the same work as dpotrf in one call, and a checkpoint after each.
/// Returns the number of the pivot that is not positive, or 0.
int factorise(Eigen::MatrixXd& A, Control* control, bool in_strips) {
    const int n = static_cast<int>(A.rows()), block = in_strips ? kCholeskyBlockInStrips : kCholeskyBlock;
    for (int k = 0; k < n; k += block) {
        const int size = std::min(block, n - k), rest = n - k - size;
        double* const corner = A.data() + static_cast<std::ptrdiff_t>(k) * n + k;
        if (const int info = LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'L', size, corner, n); info != 0) return k + info;
        if (rest > 0) {
            double* const next = corner + static_cast<std::ptrdiff_t>(size) * n + size;
            (in_strips ? update_in_strips : update_at_once)(rest, size, corner, corner + size, next, n);
        }
        if (control != nullptr) {
            control->set_progress(1.0 - std::pow(static_cast<double>(rest) / n, 3.0));
            control->checkpoint();
        }
    }
    return 0;
}

int factorise_as_fits(Eigen::MatrixXd& A, Control* control) {
    if (A.rows() <= kLargestInStrips) {
        const SerialBlas serial;
        return factorise(A, control, true);
    }
    const ParallelBlas all_threads;
    return factorise(A, control, false);
}

/// B <- op(L)^-1 B, some right sides on each thread.
void solve_triangular(const Eigen::MatrixXd& L, CBLAS_TRANSPOSE transpose, Eigen::Ref<Eigen::MatrixXd> B) {
    if (B.size() == 0) return;
    const auto n = static_cast<int>(L.rows()), stride = static_cast<int>(B.outerStride());
    for_right_sides(B.cols(), [&](Eigen::Index first, Eigen::Index count) {
        cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, transpose, CblasNonUnit, n, static_cast<int>(count), 1.0,
                    L.data(), n, B.data() + first * stride, stride);
    });
}

}  // namespace

CholeskyFactorization::CholeskyFactorization(Eigen::MatrixXd&& A, const std::string& name, Control* control)
    : factor_(std::move(A)) {
    assert(factor_.rows() == factor_.cols());
    const int n = static_cast<int>(size());
    if (n == 0) return;
    const double norm = norm_of(factor_);
    if (!std::isfinite(norm))
        throw SolveError(name + ": has entries that are not finite. Check the mesh for degenerate triangles.");
    if (const int pivot = factorise_as_fits(factor_, control); pivot != 0)
        throw SingularMatrixError(name + ": is not positive definite (pivot " + std::to_string(pivot) + " of " +
                                  std::to_string(n) + "). Check the mesh for degenerate or duplicate parts.");
    std::vector<double> work(3 * static_cast<std::size_t>(n));
    std::vector<int> iwork(static_cast<std::size_t>(n));
    const SerialBlas serial;
    LAPACKE_dpocon_work(LAPACK_COL_MAJOR, 'L', n, factor_.data(), n, norm, &reciprocal_condition_, work.data(),
                        iwork.data());
}

void CholeskyFactorization::solve_lower_in_place(Eigen::Ref<Eigen::MatrixXd> B) const {
    assert(B.rows() == size());
    solve_triangular(factor_, CblasNoTrans, B);
}

void CholeskyFactorization::solve_upper_in_place(Eigen::Ref<Eigen::MatrixXd> B) const {
    assert(B.rows() == size());
    solve_triangular(factor_, CblasTrans, B);
}

}  // namespace elastolab
