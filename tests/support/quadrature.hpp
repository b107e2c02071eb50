#pragma once

#include <array>
#include <functional>
#include <vector>

namespace elastolab::testing {

using Point = std::array<long double, 3>;
using PlanarPoint = std::array<long double, 2>;

/// Nodes and weights of the n-point Gauss-Legendre rule on [0, 1], by Newton's method in long double.
struct LegendreRule {
    explicit LegendreRule(int n);
    std::vector<long double> nodes, weights;
};

/// Adaptive integral over a triangle of a vector-valued function, to `tolerance` relative to the integral's norm. Each
/// triangle is mapped from the square with its first corner as the collapsed point (Duffy), so that a 1/r singularity
/// there is harmless; a triangle is split until the parts agree with the whole.
std::vector<long double> integrate(const std::array<Point, 3>& triangle, int n_values,
                                   const std::function<void(const Point&, std::vector<long double>&)>& function,
                                   long double tolerance = 1e-15L);

}  // namespace elastolab::testing
