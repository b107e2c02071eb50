#pragma once

#include "elasticity/triangle_kernels.hpp"

// Plain arrays only: this header is also read by sources compiled for particular instruction sets.

namespace elastolab {

/// The numbers of a pair of triangles that all Galerkin integrals are made of (elasticity/pair_integrals.hpp).
constexpr int kPairTensorNumbers = 6;  ///< of e e^T / r: xx yy zz xy xz yz
constexpr int kPairNormalNumbers = 3;  ///< of phi_k(y) (e . n_y) / r^2
constexpr int kPairNumbers = kPairTensorNumbers + kPairNormalNumbers;

/// One term of a PairRule (elasticity/pair_rules.hpp): n_x points of one triangle with n_y of the other.
struct PairRuleTerm {
    int first_x, n_x, first_y, n_y;
    double weight;  ///< of one pair of points
};

/// What an operator with surface curls makes of Q = iint e e^T / r of a pair: s = scalar tr Q, N = trace tr Q I +
/// tensor Q.
struct CurlFactors {
    double scalar, trace, tensor;
};
constexpr CurlFactors kHypersingularFactors{1.0, 1.0, -1.0};
constexpr CurlFactors double_layer_factors(double poisson_ratio) { return {0.0, 1.0 - 2.0 * poisson_ratio, 1.0}; }

/// Numbers that a test triangle and a vertex share in the operators with surface curls: p, then M by columns.
constexpr int kCurlNumbers = 12;

/// Product rules of a pair of triangles and what is made of their results, for several test triangles (one a lane) and
/// one field triangle at once.
///   x[point][axis][lane], y[point][axis], phi[point][shape]   points of the rule
///   out[number][lane] <- means of the numbers over x in the test triangle and y in the field triangle
struct PairKernels {
    int lanes;
    void (*tensor)(const double* x, const double* y, const PairRuleTerm* terms, int n_terms, double* out);
    void (*all)(const double* x, const double* y, const double* phi, const double normal[3], const PairRuleTerm* terms,
                int n_terms, double* out);
    /// For each corner k of a field triangle with surface curl c_k:  into[k] [kCurlNumbers][lane] += (s c_k, N [c_k]),
    /// [c] x = c x x, with s and N from Q [6][lane] (xx yy zz xy xz yz) by these factors. The three curls sum to zero.
    void (*add_curls)(const double* Q, const CurlFactors& factors, const double curls[3][3], double* const into[3]);
    /// out[corner][3 i + j][lane] <- alpha (2 p_i a_j - a_i p_j) - beta ([a] M)_ij for the curls a [corner][axis][lane]
    /// of the test triangles and (p, M) as add_curls sums them.
    void (*contract_curls)(double alpha, double beta, const double* a, const double* sums, double* out);
};

/// As wide as best_triangle_kernels() and plain_triangle_kernels().
const PairKernels& best_pair_kernels();
const PairKernels& plain_pair_kernels();

}  // namespace elastolab
