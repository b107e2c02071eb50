#pragma once

#include <array>
#include <vector>

#include "elasticity/pair_kernels.hpp"

namespace elastolab {

/// A rule for the mean of f(x, y) over x in one triangle and y in another, symmetric under every renumbering of either
/// triangle's corners and under exchange of the two:
///   mean f ~ sum over terms, weight * (sum of f over points[first_x ...] x points[first_y ...])
/// Exact for polynomials of total degree `degree` in the four coordinates together, so that it needs half to a third of
/// the points of a product of two rules of that degree. Points are barycentric.
struct PairRule {
    int degree = 0;
    int n_pairs = 0;  ///< pairs of points
    std::vector<std::array<double, 3>> points;
    std::vector<PairRuleTerm> terms;
};

/// Degree 5 with 25 pairs of points, 7 with 69, 9 with 159, 11 with 364: solutions of the moment equations of the
/// symmetric polynomials, found by damped Gauss-Newton steps from random points, leaving out one term after the other
/// (node elimination, Xiao and Gimbutas 2010), to 30 digits.
const PairRule& pair_rule_5();
const PairRule& pair_rule_7();
const PairRule& pair_rule_9();
const PairRule& pair_rule_11();

}  // namespace elastolab
