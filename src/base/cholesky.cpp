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

namespace elastolab {

namespace {

/// Columns factorised between two checkpoints.
constexpr int kCholeskyBlock = 768;

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

/// Right-looking, by block columns: the same work as dpotrf in one call, and a checkpoint after each.
/// Returns the number of the pivot that is not positive, or 0.
int factorise(Eigen::MatrixXd& A, Control* control) {
    const ParallelBlas all_threads;
    const int n = static_cast<int>(A.rows());
    for (int k = 0; k < n; k += kCholeskyBlock) {
        const int size = std::min(kCholeskyBlock, n - k), rest = n - k - size;
        double* const corner = A.data() + static_cast<std::ptrdiff_t>(k) * n + k;
        if (const int info = LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'L', size, corner, n); info != 0) return k + info;
        if (rest > 0) {
            double* const below = corner + size;
            cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, rest, size, 1.0, corner, n,
                        below, n);
            cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, rest, size, -1.0, below, n, 1.0,
                        corner + static_cast<std::ptrdiff_t>(size) * n + size, n);
        }
        if (control != nullptr) {
            control->set_progress(1.0 - std::pow(static_cast<double>(rest) / n, 3.0));
            control->checkpoint();
        }
    }
    return 0;
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
    if (const int pivot = factorise(factor_, control); pivot != 0)
        throw SingularMatrixError(name + ": is not positive definite (pivot " + std::to_string(pivot) + " of " +
                                  std::to_string(n) + "). Check the mesh for degenerate or duplicate parts.");
    std::vector<double> work(3 * static_cast<std::size_t>(n));
    std::vector<int> iwork(static_cast<std::size_t>(n));
    LAPACKE_dpocon_work(LAPACK_COL_MAJOR, 'L', n, factor_.data(), n, norm, &reciprocal_condition_, work.data(),
                        iwork.data());
}

void CholeskyFactorization::solve_lower_in_place(Eigen::Ref<Eigen::MatrixXd> B) const {
    assert(B.rows() == size());
    if (B.size() == 0) return;
    const int n = static_cast<int>(size());
    cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, n, static_cast<int>(B.cols()), 1.0,
                factor_.data(), n, B.data(), static_cast<int>(B.outerStride()));
}

void CholeskyFactorization::solve_upper_in_place(Eigen::Ref<Eigen::MatrixXd> B) const {
    assert(B.rows() == size());
    if (B.size() == 0) return;
    const int n = static_cast<int>(size());
    cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasTrans, CblasNonUnit, n, static_cast<int>(B.cols()), 1.0,
                factor_.data(), n, B.data(), static_cast<int>(B.outerStride()));
}

}  // namespace elastolab
