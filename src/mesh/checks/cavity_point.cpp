#include "mesh/checks/cavity_point.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <limits>
#include <vector>

#include "mesh/measures.hpp"

namespace elastolab {

using Eigen::Vector3d;

namespace {

/// The s > 0 at which the ray origin + s direction meets the triangle; infinity if nowhere. Edges are widened a little:
/// a ray that slipped through between two triangles would overestimate the hole.
double ray_hit(const Vector3d& origin, const Vector3d& direction, const TrianglePoints& p) {
    constexpr double kNever = std::numeric_limits<double>::infinity(), kEdgeTolerance = 1e-9;
    const Vector3d ab = p.b - p.a, ac = p.c - p.a, q = direction.cross(ac);
    const double det = ab.dot(q);
    if (det == 0.0) return kNever;
    const Vector3d ao = origin - p.a, r = ao.cross(ab);
    const double u = ao.dot(q) / det, v = direction.dot(r) / det, s = ac.dot(r) / det;
    const bool inside = u >= -kEdgeTolerance && v >= -kEdgeTolerance && u + v <= 1.0 + kEdgeTolerance;
    return inside && s > 0.0 ? s : kNever;
}

}  // namespace

Vector3d point_in_cavity(const SurfaceMesh& mesh, std::span<const int> cavity) {
    constexpr std::size_t kTries = 16;
    std::vector<int> largest(cavity.begin(), cavity.end());
    const std::size_t n_tries = std::min(kTries, largest.size());
    const auto area = [&](int t) { return area_vector(triangle_points(mesh, t)).squaredNorm(); };
    std::partial_sort(largest.begin(), largest.begin() + static_cast<std::ptrdiff_t>(n_tries), largest.end(),
                      [&](int s, int t) { return area(s) > area(t); });
    Vector3d best = Vector3d::Zero();
    double widest = -1.0;
    for (std::size_t i = 0; i < n_tries; ++i) {
        const TrianglePoints from = triangle_points(mesh, largest[i]);
        const Vector3d center = (from.a + from.b + from.c) / 3.0, direction = area_vector(from).normalized();
        double gap = std::numeric_limits<double>::infinity();
        for (const int t : cavity)
            if (t != largest[i]) gap = std::min(gap, ray_hit(center, direction, triangle_points(mesh, t)));
        if (std::isfinite(gap) && gap > widest) {
            widest = gap;
            best = center + 0.5 * gap * direction;
        }
    }
    return best;
}

}  // namespace elastolab
