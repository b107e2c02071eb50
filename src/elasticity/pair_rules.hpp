#pragma once

#include <array>
#include <vector>

#include "elasticity/pair_kernels.hpp"

namespace elastolab {

/// A rule for the mean of f(x, y) over x in one triangle and y in another, symmetric under every renumbering of either
/// triangle's corners and under exchange of the two:
///   mean f ~ sum over terms, weight * (sum of f over points[first_x ...] x points[first_y ...])
/// Exact for polynomials of total degree `degree` in the four coordinates together, so that it needs a third of the
/// points of a product of two rules of that degree. Points are barycentric.
struct PairRule {
    int degree = 0;
    int n_pairs = 0;  ///< pairs of points
    std::vector<std::array<double, 3>> points;
    std::vector<PairRuleTerm> terms;
};

/// Degree 5 with 25 pairs of points, degree 7 with 69 (found by Newton's method on the moment equations of the
/// symmetric polynomials), degree 8 with 256 (the product of two rules of 16 points).
const PairRule& pair_rule_5();
const PairRule& pair_rule_7();
const PairRule& pair_rule_8();

/// The n-point Gauss-Legendre rule on [0, 1]: n <= kMaxLegendre.
constexpr int kMaxLegendre = 20;
struct LineRule {
    std::vector<double> nodes, weights;
};
const LineRule& legendre_rule(int n);

/// n^2 points on a triangle, exact to degree 2n - 2: Gauss-Legendre on the square, collapsed to the first corner
/// (Duffy). Barycentric points, weights that sum to one.
struct CollapsedRule {
    std::vector<std::array<double, 3>> points;
    std::vector<double> weights;
};
const CollapsedRule& collapsed_rule(int n);

}  // namespace elastolab
