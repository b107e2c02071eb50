#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace elastolab {

/// The points that arise from one point by renumbering the corners. That point is given in the complex plane whose
/// origin is the centroid of an equilateral triangle with corners at 1, e^(2 pi i/3), e^(-2 pi i/3): rho e^(i theta),
/// cosine = cos(3 theta). An orbit is the centroid itself (rho = 0), three points on the lines to the corners
/// (cosine = 1), or six.
struct Orbit {
    double rho, cosine = 1.0;
    bool operator==(const Orbit&) const = default;
};

/// Barycentric.
inline std::vector<std::array<double, 3>> points_of(const Orbit& orbit) {
    const int n = orbit.rho == 0.0 ? 1 : orbit.cosine == 1.0 ? 3 : 6;
    const double turn = 2.0 * std::numbers::pi / 3.0, theta = std::acos(orbit.cosine) / 3.0;
    std::vector<std::array<double, 3>> points;
    for (int i = 0; i < n; ++i) {
        const double angle = (i < 3 ? theta : -theta) + turn * (i % 3);
        const auto coordinate = [&](int k) { return (1.0 + 2.0 * orbit.rho * std::cos(angle - turn * k)) / 3.0; };
        points.push_back({coordinate(0), coordinate(1), coordinate(2)});
    }
    return points;
}

}  // namespace elastolab
