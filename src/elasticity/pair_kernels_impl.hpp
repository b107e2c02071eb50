#pragma once

// Product rules for a vector type B of several doubles (or one double). Included by one source per instruction set and
// by nothing else; everything lives in an unnamed namespace, so that no function compiled for one instruction set can
// be linked into code for another.

#include <cmath>
#include <xsimd/xsimd.hpp>

#include "elasticity/pair_kernels.hpp"

namespace elastolab {
namespace {

template <class B>
struct PairLanes {
    static constexpr int kCount = static_cast<int>(B::size);
    static B load(const double* p) { return B::load_unaligned(p); }
    static void store(double* p, const B& value) { value.store_unaligned(p); }
    /// x^(-3/2)
    static B inverse_cube_of_root(const B& x) { return B(1.0) / (x * xsimd::sqrt(x)); }
};

template <>
struct PairLanes<double> {
    static constexpr int kCount = 1;
    static double load(const double* p) { return *p; }
    static void store(double* p, double value) { *p = value; }
    static double inverse_cube_of_root(double x) { return 1.0 / (x * std::sqrt(x)); }
};

#if defined(__AVX512F__)
/// 14 bits of the instruction and three terms of the series of (1 - e)^(-3/2) make full precision, at a third of what
/// a root and a division take.
template <>
inline xsimd::batch<double, xsimd::avx512dq> PairLanes<xsimd::batch<double, xsimd::avx512dq>>::inverse_cube_of_root(
    const xsimd::batch<double, xsimd::avx512dq>& x) {
    const __m512d v = x, y = _mm512_rsqrt14_pd(v), y2 = _mm512_mul_pd(y, y), y3 = _mm512_mul_pd(y2, y);
    const __m512d e = _mm512_fnmadd_pd(v, y2, _mm512_set1_pd(1.0));
    __m512d series = _mm512_fmadd_pd(e, _mm512_set1_pd(2.1875), _mm512_set1_pd(1.875));
    series = _mm512_fmadd_pd(e, series, _mm512_set1_pd(1.5));
    return _mm512_fmadd_pd(_mm512_mul_pd(y3, e), series, y3);
}
#endif

template <class B>
void add_tensor_at(const B (&d)[3], const B& inverse_r3, B (&sum)[kPairTensorNumbers]) {
    const B x = inverse_r3 * d[0], y = inverse_r3 * d[1], z = inverse_r3 * d[2];
    sum[0] += x * d[0];
    sum[1] += y * d[1];
    sum[2] += z * d[2];
    sum[3] += x * d[1];
    sum[4] += x * d[2];
    sum[5] += y * d[2];
}

template <class B, bool kAll>
void product_rule(const double* x, const double* y, const double* phi, const double* normal, const PairRuleTerm* terms,
                  int n_terms, double* out) {
    constexpr int kLanes = PairLanes<B>::kCount;
    B total[kPairTensorNumbers], normal_total[3] = {B(0.0), B(0.0), B(0.0)};
    for (B& number : total) number = B(0.0);
    for (int t = 0; t < n_terms; ++t) {
        const PairRuleTerm& term = terms[t];
        B sum[kPairTensorNumbers];
        for (B& number : sum) number = B(0.0);
        for (int j = term.first_y; j < term.first_y + term.n_y; ++j) {
            const B y0(y[3 * j]), y1(y[3 * j + 1]), y2(y[3 * j + 2]);
            B normal_sum(0.0);
            for (int i = term.first_x; i < term.first_x + term.n_x; ++i) {
                const double* p = x + 3 * kLanes * i;
                const B d[3] = {y0 - PairLanes<B>::load(p), y1 - PairLanes<B>::load(p + kLanes),
                                y2 - PairLanes<B>::load(p + 2 * kLanes)};
                const B inverse_r3 = PairLanes<B>::inverse_cube_of_root(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
                add_tensor_at(d, inverse_r3, sum);
                if constexpr (kAll)
                    normal_sum += (d[0] * B(normal[0]) + d[1] * B(normal[1]) + d[2] * B(normal[2])) * inverse_r3;
            }
            if constexpr (kAll)
                for (int k = 0; k < 3; ++k) normal_total[k] += B(term.weight * phi[3 * j + k]) * normal_sum;
        }
        for (int k = 0; k < kPairTensorNumbers; ++k) total[k] += B(term.weight) * sum[k];
    }
    for (int k = 0; k < kPairTensorNumbers; ++k) PairLanes<B>::store(out + k * kLanes, total[k]);
    if constexpr (kAll)
        for (int k = 0; k < kPairNormalNumbers; ++k)
            PairLanes<B>::store(out + (kPairTensorNumbers + k) * kLanes, normal_total[k]);
}

template <class B>
void tensor_rule(const double* x, const double* y, const PairRuleTerm* terms, int n_terms, double* out) {
    product_rule<B, false>(x, y, nullptr, nullptr, terms, n_terms, out);
}

template <class B>
void whole_rule(const double* x, const double* y, const double* phi, const double* normal, const PairRuleTerm* terms,
                int n_terms, double* out) {
    product_rule<B, true>(x, y, phi, normal, terms, n_terms, out);
}

/// N [c], by columns: N (c x e_j).
template <class B>
void curl_columns(const B (&N)[6], const double* c, B (&M)[9]) {
    const B c0(c[0]), c1(c[1]), c2(c[2]);
    constexpr int kColumn[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
    for (int i = 0; i < 3; ++i) {
        const B &n0 = N[kColumn[0][i]], &n1 = N[kColumn[1][i]], &n2 = N[kColumn[2][i]];
        M[i] = c2 * n1 - c1 * n2;
        M[3 + i] = c0 * n2 - c2 * n0;
        M[6 + i] = c1 * n0 - c0 * n1;
    }
}

template <class B>
void add_curls(const double* Q, const CurlFactors& factors, const double curls[3][3], double* const into[3]) {
    constexpr int kLanes = PairLanes<B>::kCount;
    B N[6], last[kCurlNumbers];
    for (int k = 0; k < 6; ++k) N[k] = PairLanes<B>::load(Q + k * kLanes);
    const B trace = N[0] + N[1] + N[2], scalar = B(factors.scalar) * trace;
    for (int k = 0; k < 6; ++k) N[k] = B(factors.tensor) * N[k];
    for (int k = 0; k < 3; ++k) N[k] += B(factors.trace) * trace;
    for (B& number : last) number = B(0.0);
    for (int corner = 0; corner < 2; ++corner) {
        B M[9];
        curl_columns(N, curls[corner], M);
        for (int k = 0; k < kCurlNumbers; ++k) {
            const B value = k < 3 ? B(curls[corner][k]) * scalar : M[k < 3 ? 0 : k - 3];
            double* p = into[corner] + k * kLanes;
            PairLanes<B>::store(p, PairLanes<B>::load(p) + value);
            last[k] -= value;
        }
    }
    for (int k = 0; k < kCurlNumbers; ++k) {
        double* p = into[2] + k * kLanes;
        PairLanes<B>::store(p, PairLanes<B>::load(p) + last[k]);
    }
}

template <class B>
void contract_curls(double alpha, double beta, const double* a, const double* sums, double* out) {
    constexpr int kLanes = PairLanes<B>::kCount;
    B p[3], M[9];
    for (int k = 0; k < 3; ++k) p[k] = B(alpha) * PairLanes<B>::load(sums + k * kLanes);
    for (int k = 0; k < 9; ++k) M[k] = B(beta) * PairLanes<B>::load(sums + (3 + k) * kLanes);
    for (int corner = 0; corner < 3; ++corner) {
        B c[3];
        for (int i = 0; i < 3; ++i) c[i] = PairLanes<B>::load(a + (3 * corner + i) * kLanes);
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 3; ++i) {
                const int u = (i + 1) % 3, v = (i + 2) % 3;
                const B cross = c[u] * M[3 * j + v] - c[v] * M[3 * j + u];
                PairLanes<B>::store(out + (9 * corner + 3 * i + j) * kLanes,
                                    B(2.0) * p[i] * c[j] - c[i] * p[j] - cross);
            }
    }
}

template <class B>
constexpr PairKernels make_pair_kernels() {
    return {PairLanes<B>::kCount, &tensor_rule<B>, &whole_rule<B>, &add_curls<B>, &contract_curls<B>};
}

}  // namespace
}  // namespace elastolab
