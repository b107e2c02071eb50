#include "base/blocked_lu.hpp"

#include <cblas.h>
#include <lapacke.h>

#include <algorithm>
#include <cassert>

#include "base/blas.hpp"
#include "base/strips.hpp"

namespace elastolab {

namespace {

/// Columns of a block: enough for fast products, few enough that factorising the block, which the BLAS parallelises
/// less well or one thread does, takes little of the time. The fastest of 192, 256, 384 and 512 at 9000 rows.
constexpr int kBlock = 256, kLuBlockInStrips = 96;

int getrf(int m, int n, double* A, int stride, int* pivots) {
    return LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, m, n, A, stride, pivots);
}
int getrf(int m, int n, float* A, int stride, int* pivots) {
    return LAPACKE_sgetrf_work(LAPACK_COL_MAJOR, m, n, A, stride, pivots);
}
void exchange_rows(int n, double* A, int stride, int first, int end, const int* pivots) {
    LAPACKE_dlaswp_work(LAPACK_COL_MAJOR, n, A, stride, first + 1, end, pivots, 1);
}
void exchange_rows(int n, float* A, int stride, int first, int end, const int* pivots) {
    LAPACKE_slaswp_work(LAPACK_COL_MAJOR, n, A, stride, first + 1, end, pivots, 1);
}
/// B <- L^-1 B, L unit lower triangular.
void solve_lower(int m, int n, const double* L, double* B, int stride) {
    cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasUnit, m, n, 1.0, L, stride, B, stride);
}
void solve_lower(int m, int n, const float* L, float* B, int stride) {
    cblas_strsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasUnit, m, n, 1.0F, L, stride, B, stride);
}
/// C <- C - A B.
void subtract_product(int m, int n, int k, const double* A, const double* B, double* C, int stride) {
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, m, n, k, -1.0, A, stride, B, stride, 1.0, C, stride);
}
void subtract_product(int m, int n, int k, const float* A, const float* B, float* C, int stride) {
    cblas_sgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, m, n, k, -1.0F, A, stride, B, stride, 1.0F, C, stride);
}

/// Calls update(first, end) for all columns from `begin` on.
template <class Update>
void update_columns(int begin, int n, bool in_strips, const Update& update) {
    if (!in_strips) return update(begin, n);
    for_strips(n - begin, [&](Eigen::Index first, Eigen::Index count) {
        const int from = begin + static_cast<int>(first);
        update(from, from + static_cast<int>(count));
    });
}

template <class Matrix>
int factorise(Matrix& A, std::vector<int>& pivots, Control* control, bool in_strips) {
    assert(A.rows() == A.cols());
    const int n = static_cast<int>(A.rows());
    pivots.resize(static_cast<std::size_t>(n));
    const auto at = [&](int row, int column) { return A.data() + row + static_cast<std::ptrdiff_t>(column) * n; };
    int first_zero = 0;
    const int block = in_strips ? kLuBlockInStrips : kBlock;
    for (int begin = 0; begin < n; begin += block) {
        if (control != nullptr) {
            const double left = static_cast<double>(n - begin) / n;
            control->set_progress(1.0 - left * left * left);
            control->checkpoint();
        }
        const int width = std::min(block, n - begin), end = begin + width;
        const int zero = getrf(n - begin, width, at(begin, begin), n, pivots.data() + begin);
        assert(zero >= 0);
        if (zero > 0 && first_zero == 0) first_zero = begin + zero;
        for (int i = begin; i < end; ++i) pivots[static_cast<std::size_t>(i)] += begin;
        if (begin > 0) exchange_rows(begin, A.data(), n, begin, end, pivots.data());
        if (end == n) break;
        update_columns(end, n, in_strips, [&](int first, int last) {
            exchange_rows(last - first, at(0, first), n, begin, end, pivots.data());
            solve_lower(width, last - first, at(begin, begin), at(begin, first), n);
            subtract_product(n - end, last - first, width, at(end, begin), at(begin, first), at(end, first), n);
        });
    }
    return first_zero;
}

template <class Matrix>
int factorise_as_fits(Matrix& A, std::vector<int>& pivots, Control* control, int in_strips) {
    if (A.rows() <= in_strips) {
        const SerialBlas serial;
        return factorise(A, pivots, control, true);
    }
    const ParallelBlas all_threads;
    return factorise(A, pivots, control, false);
}

}  // namespace

int factorise_lu(Eigen::MatrixXd& A, std::vector<int>& pivots, Control* control, int in_strips) {
    return factorise_as_fits(A, pivots, control, in_strips);
}
int factorise_lu(Eigen::MatrixXf& A, std::vector<int>& pivots, Control* control, int in_strips) {
    return factorise_as_fits(A, pivots, control, in_strips);
}

}  // namespace elastolab
