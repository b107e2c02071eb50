#include "findings/surface.hpp"

#include <algorithm>
#include <Eigen/Geometry>
#include <limits>

#include "mesh/measures.hpp"
#include "mesh/surface_distance.hpp"
#include "mesh/triangles_across.hpp"

namespace elastolab {

namespace {

/// Relative error of an integral above which lost digits are reported.
constexpr double kLostIntegralDigits = 1e-6;
/// Distance to the facing side over the longest edge of the triangle there. One cell of constant elements bends badly.
constexpr double kThinWall = 0.5, kThinWallOfConstant = 0.8;
constexpr double kSlender = 15.0;   ///< length over thickness
constexpr double kTouching = 0.01;  ///< of the mean edge

double longest_edge(const TrianglePoints& p) {
    return std::max({(p.b - p.a).norm(), (p.c - p.b).norm(), (p.a - p.c).norm()});
}

double mean_longest_edge(const SurfaceMesh& surface) {
    double sum = 0.0;
    for (int t = 0; t < surface.n_triangles(); ++t) sum += longest_edge(triangle_points(surface, t));
    return sum / std::max(surface.n_triangles(), 1);
}

/// The thinnest triangle, if boundary integrals over it lose digits.
void add_thin_triangle(const SurfaceMesh& surface, Findings& findings) {
    double thinnest = 1.0;
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    for (int t = 0; t < surface.n_triangles(); ++t) {
        const TrianglePoints p = triangle_points(surface, t);
        const double longest = longest_edge(p), ratio = area_vector(p).norm() / (longest * longest);
        if (ratio >= thinnest) continue;
        thinnest = ratio;
        place = (p.a + p.b + p.c) / 3.0;
    }
    if (10.0 * std::numeric_limits<double>::epsilon() / (thinnest * thinnest) < kLostIntegralDigits) return;
    findings.push_back({.kind = FindingKind::thin_triangle, .value = thinnest, .place = place});
}

/// Length over thickness (mesh/triangles_across.hpp): that of a bar, twice that of a plate. A plate is as long as its
/// box, what is wound as the way along it.
void add_slenderness(const SurfaceMesh& surface, MethodKind method, Findings& findings) {
    const double straight = (surface.vertices.rowwise().maxCoeff() - surface.vertices.rowwise().minCoeff()).norm();
    const double length = std::max(straight, length_along_surface(surface));
    const double thick = thickness(surface);
    if (length >= kSlender * thick)
        findings.push_back({.kind = FindingKind::slender_body, .value = length / thick, .method = method});
}

}  // namespace

Findings findings_of_surface(const SurfaceMesh& surface, MethodKind method, Control& control) {
    Findings findings;
    if (!method->integrates_boundary) return findings;
    add_thin_triangle(surface, findings);
    if (!method->balances_forces) add_slenderness(surface, method, findings);
    control.checkpoint();
    const FacingApproach wall = closest_facing_approach(surface, control);
    if (wall.ratio < (method->shows_averages ? kThinWallOfConstant : kThinWall))
        findings.push_back({.kind = FindingKind::thin_wall,
                            .value = wall.ratio,
                            .method = method,
                            .place = surface.vertices.col(wall.vertex)});
    return findings;
}

Findings findings_of_contact(const SurfaceMesh& surface, std::span<const std::vector<int>> parts) {
    if (parts.size() < 2) return {};
    const std::optional<Contact> contact = find_contact(surface, parts, kTouching * mean_longest_edge(surface));
    if (!contact) return {};
    return {{.kind = FindingKind::contact,
             .place = surface.vertices.col(contact->vertex),
             .first = static_cast<int>(contact->first),
             .second = static_cast<int>(contact->second)}};
}

}  // namespace elastolab
