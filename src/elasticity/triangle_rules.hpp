#pragma once

#include <array>
#include <vector>

namespace elastolab {

/// The n-point Gauss-Legendre rule on [0, 1]: n <= kMaxLegendre.
constexpr int kMaxLegendre = 20;
struct LineRule {
    std::vector<double> nodes, weights;
};
const LineRule& legendre_rule(int n);

/// A rule on a triangle, exact to degree 2n - 2: barycentric points, weights that sum to one. 3, 6, 12, 16, 25, 33 and
/// 42 points, symmetric under every renumbering of the corners, for n = 2 to 8 (the orbits of Dunavant 1985, to 18
/// digits by Newton's method on their moment equations); from n = 9 on n^2: Gauss-Legendre on the square, collapsed to
/// the first corner (Duffy).
struct TriangleRule {
    std::vector<std::array<double, 3>> points;
    std::vector<double> weights;
};
const TriangleRule& triangle_rule(int n);

}  // namespace elastolab
