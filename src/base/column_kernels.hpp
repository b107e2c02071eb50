#pragma once

#include <cstddef>

// Plain arrays only: this header is read by sources compiled for particular instruction sets.

namespace elastolab {

/// What base/mixed_product.hpp and base/column_sum.hpp do for one column x (or result); A by columns, `stride` apart.
struct ColumnKernels {
    /// y[rows] = rest + A x; y overlaps none of them
    void (*sum)(const double* rest, const double* A, std::ptrdiff_t stride, std::ptrdiff_t rows, std::ptrdiff_t cols,
                const double* x, double* y);
    /// y[rows] += A x
    void (*add)(const float* A, std::ptrdiff_t stride, std::ptrdiff_t rows, std::ptrdiff_t cols, const double* x,
                double* y);
    /// y[cols] += A^T x
    void (*add_transposed)(const float* A, std::ptrdiff_t stride, std::ptrdiff_t rows, std::ptrdiff_t cols,
                           const double* x, double* y);
};

/// Those that were compiled for this CPU.
const ColumnKernels& column_kernels();

/// Rows for one call: so few that their part of x or y stays in the L1 cache.
constexpr std::ptrdiff_t kRowsAtOnce = 1024;

// NOLINTBEGIN(misc-definitions-in-headers): each source compiles its own.
namespace {

/// Columns of A taken together: y (for A^T: x) is then read from the cache a fourth as often.
constexpr std::ptrdiff_t kColumnsAtOnce = 4;

void sum_columns(const double* rest, const double* A, std::ptrdiff_t stride, std::ptrdiff_t rows, std::ptrdiff_t cols,
                 const double* x, double* y) {
    std::ptrdiff_t c = 0;
    for (; c + 3 <= cols; c += 3, rest = y) {  // a motion has a column for each of its three directions
        const double *a0 = A + c * stride, *a1 = a0 + stride, *a2 = a1 + stride;
        const double x0 = x[c], x1 = x[c + 1], x2 = x[c + 2];
#pragma omp simd
        for (std::ptrdiff_t r = 0; r < rows; ++r) y[r] = rest[r] + (a0[r] * x0 + a1[r] * x1 + a2[r] * x2);
    }
    for (; c < cols; ++c, rest = y) {
        const double* a = A + c * stride;
#pragma omp simd
        for (std::ptrdiff_t r = 0; r < rows; ++r) y[r] = rest[r] + a[r] * x[c];
    }
    if (cols == 0)
        for (std::ptrdiff_t r = 0; r < rows; ++r) y[r] = rest[r];
}

void add_columns(const float* A, std::ptrdiff_t stride, std::ptrdiff_t rows, std::ptrdiff_t cols, const double* x,
                 double* y) {
    std::ptrdiff_t c = 0;
    for (; c + kColumnsAtOnce <= cols; c += kColumnsAtOnce) {
        const float *a0 = A + c * stride, *a1 = a0 + stride, *a2 = a1 + stride, *a3 = a2 + stride;
        const double x0 = x[c], x1 = x[c + 1], x2 = x[c + 2], x3 = x[c + 3];
#pragma omp simd
        for (std::ptrdiff_t r = 0; r < rows; ++r)
            y[r] += (double{a0[r]} * x0 + double{a1[r]} * x1) + (double{a2[r]} * x2 + double{a3[r]} * x3);
    }
    for (; c < cols; ++c) {
        const float* a = A + c * stride;
#pragma omp simd
        for (std::ptrdiff_t r = 0; r < rows; ++r) y[r] += double{a[r]} * x[c];
    }
}

void add_dot_products(const float* A, std::ptrdiff_t stride, std::ptrdiff_t rows, std::ptrdiff_t cols, const double* x,
                      double* y) {
    std::ptrdiff_t c = 0;
    for (; c + kColumnsAtOnce <= cols; c += kColumnsAtOnce) {
        const float *a0 = A + c * stride, *a1 = a0 + stride, *a2 = a1 + stride, *a3 = a2 + stride;
        double y0 = 0.0, y1 = 0.0, y2 = 0.0, y3 = 0.0;
#pragma omp simd reduction(+ : y0, y1, y2, y3)
        for (std::ptrdiff_t r = 0; r < rows; ++r) {
            y0 += double{a0[r]} * x[r];
            y1 += double{a1[r]} * x[r];
            y2 += double{a2[r]} * x[r];
            y3 += double{a3[r]} * x[r];
        }
        y[c] += y0;
        y[c + 1] += y1;
        y[c + 2] += y2;
        y[c + 3] += y3;
    }
    for (; c < cols; ++c) {
        const float* a = A + c * stride;
        double sum = 0.0;
#pragma omp simd reduction(+ : sum)
        for (std::ptrdiff_t r = 0; r < rows; ++r) sum += double{a[r]} * x[r];
        y[c] += sum;
    }
}

constexpr ColumnKernels kPlainColumnKernels = {sum_columns, add_columns, add_dot_products};

}  // namespace
// NOLINTEND(misc-definitions-in-headers)

}  // namespace elastolab
