#pragma once

#include <array>

namespace elastolab {

/// A symmetric Gauss rule on a triangle: barycentric points and weights that sum to one.
struct GaussRule {
    static constexpr int kMaxPoints = 16;
    int n_points = 0;
    int degree = 0;  ///< polynomials up to this degree are integrated exactly
    std::array<std::array<double, 3>, kMaxPoints> points{};
    std::array<double, kMaxPoints> weights{};
};

/// Rules with 3 (degree 2), 7 (degree 5) and 16 points (degree 8). Source: docs/formulation.md [13].
const GaussRule& gauss_rule_3();
const GaussRule& gauss_rule_7();
const GaussRule& gauss_rule_16();

}  // namespace elastolab
