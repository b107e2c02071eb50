#include "findings/guards.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <limits>

#include "base/text.hpp"
#include "mesh/surface_distance.hpp"
#include "mesh/measures.hpp"
#include "mesh/topology.hpp"

namespace elastolab {

namespace {

using Eigen::Vector3d;

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kLocking = 0.48;
constexpr double kLostDigits = 1e-6;  ///< relative error of displacements from which on rounding is told
/// Distance of the other side over the longest edge of the triangle there. Constant elements bend one cell badly.
constexpr double kThinWall = 0.5, kThinWallOfConstant = 0.8;
constexpr double kSlender = 15.0;     ///< length over thickness
constexpr double kTouching = 0.01;    ///< of the mean edge
constexpr double kWeakLever = 100.0;  ///< by how much an error of a handle may be amplified

double longest_edge(const TrianglePoints& p) {
    return std::max({(p.b - p.a).norm(), (p.c - p.b).norm(), (p.a - p.c).norm()});
}

double mean_edge(const SurfaceMesh& surface) {
    double sum = 0.0;
    for (int t = 0; t < surface.n_triangles(); ++t) sum += longest_edge(triangle_points(surface, t));
    return sum / std::max(surface.n_triangles(), 1);
}

/// The thinnest triangle, if boundary integrals over it lose digits.
void warn_of_slivers(const SurfaceMesh& surface, std::vector<std::string>& warnings) {
    double thinnest = 1.0;
    int worst = -1;
    for (int t = 0; t < surface.n_triangles(); ++t) {
        const TrianglePoints p = triangle_points(surface, t);
        const double longest = longest_edge(p), ratio = area_vector(p).norm() / (longest * longest);
        if (ratio < thinnest) {
            thinnest = ratio;
            worst = t;
        }
    }
    const double lost = 10.0 * kEps / (thinnest * thinnest);
    if (worst < 0 || lost < kLostDigits) return;
    const TrianglePoints p = triangle_points(surface, worst);
    warnings.push_back("boundary elements: the triangle at " + readable_point((p.a + p.b + p.c) / 3.0) +
                       " is so thin (" + readable_number(thinnest) +
                       " of its length) that its integrals are right to " + readable_number(lost) +
                       " only. Remesh the surface there, or choose fem.");
}

/// Length over thickness, 4 volume / area: that of a bar, twice that of a plate.
void warn_of_slenderness(const SurfaceMesh& surface, std::vector<std::string>& warnings) {
    const double length = (surface.vertices.rowwise().maxCoeff() - surface.vertices.rowwise().minCoeff()).norm();
    const double thickness = 4.0 * enclosed_volume(surface) / surface_area(surface);
    if (length < kSlender * thickness) return;
    warnings.push_back("boundary elements: the body is " + readable_number(length / thickness) +
                       " times as long as thick. With one or two elements across, linear-bem is off by 9 % in the "
                       "bending of a bar that is 20 times as long as thick, by 15 % at 40 times (constant-bem by "
                       "more). Refine, or compare with fem.");
}

}  // namespace

std::vector<std::string> warn_of_locking(double poisson_ratio) {
    if (poisson_ratio <= kLocking) return {};
    return {"fem: linear tetrahedra lock at Poisson's ratio " + readable_number(poisson_ratio, 6) +
            ": in bending their error at 0.49 is 3 times that at 0.3, at 0.499 9 times, at 0.4999 29 times (a tenth of "
            "the displacement on a coarse bar). Choose linear-bem, which does not lock, or refine."};
}

std::vector<std::string> warn_of_condition(const std::string& what, double condition) {
    const double off = condition * kEps;
    if (!(off > kLostDigits)) return {};
    return {what + ": nearly dependent equations (condition " + readable_number(condition) +
            "), so displacements may be off by " + readable_number(std::min(off, 1.0)) +
            " of their size, and forces by more. Remove handles that nearly coincide, slivers, or a Poisson's ratio "
            "next to 1/2."};
}

std::vector<std::string> warn_of_surface(const SurfaceMesh& surface, bool constant) {
    std::vector<std::string> warnings;
    warn_of_slivers(surface, warnings);
    warn_of_slenderness(surface, warnings);
    const Approach wall = closest_facing_approach(surface);
    if (wall.ratio < (constant ? kThinWallOfConstant : kThinWall))
        warnings.push_back(
            "boundary elements: the surface near " + readable_point(surface.vertices.col(wall.vertex)) + " is only " +
            readable_number(wall.ratio) +
            " of a triangle's edge away from its other side. Walls and gaps that thin bend with errors " +
            (constant ? "of 30 to 40 %. Refine there, or choose linear-bem."
                      : "of 5 to 20 %. Refine there, or compare with fem."));
    return warnings;
}

std::vector<std::string> warn_of_contact(const SurfaceMesh& surface, std::span<const std::vector<int>> parts) {
    if (parts.size() < 2) return {};
    const std::optional<Contact> contact = find_contact(surface, parts, kTouching * mean_edge(surface));
    if (!contact) return {};
    return {"solids " + std::to_string(contact->first + 1) + " and " + std::to_string(contact->second + 1) +
            ": touch near " + readable_point(surface.vertices.col(contact->vertex)) +
            ", but are separate bodies, which neither stick together nor push each other. Join their surfaces if they "
            "are one body."};
}

std::vector<std::string> warn_of_point_constraints(const SurfaceMesh& surface, std::span<const int> constrained) {
    std::vector<char> is_constrained(static_cast<std::size_t>(surface.n_vertices()), 0), in_patch = is_constrained;
    const auto at = [](int v) { return static_cast<std::size_t>(v); };
    for (const int v : constrained) is_constrained[at(v)] = 1;
    for (const auto& t : surface.triangles.colwise())
        if (is_constrained[at(t[0])] && is_constrained[at(t[1])] && is_constrained[at(t[2])])
            for (const int v : t) in_patch[at(v)] = 1;
    int count = 0, first = -1;
    for (const int v : constrained)
        if (!in_patch[at(v)] && count++ == 0) first = v;
    if (count == 0) return {};
    std::string others = " is";
    if (count > 1) others = std::string(" and ").append(std::to_string(count - 1)).append(" more are");
    return {"constraints: vertex " + std::to_string(first) + " at " + readable_point(surface.vertices.col(first)) +
            others +
            " held or moved alone, with no whole triangle. How far the body follows a point depends on the mesh; take "
            "all vertices within a radius."};
}

std::vector<std::string> warn_of_weak_hold(const SurfaceMesh& surface, std::span<const int> solid,
                                           std::span<const int> constrained) {
    const auto n = static_cast<double>(constrained.size());
    if (constrained.size() < 3) return {};
    Vector3d centre = Vector3d::Zero();
    for (const int v : constrained) centre += surface.vertices.col(v) / n;
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const int v : constrained) {
        const Vector3d d = surface.vertices.col(v) - centre;
        spread += d * d.transpose() / n;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
    const Vector3d line = axes.eigenvectors().col(2);
    double reach = 0.0;
    for (const int v : solid) reach = std::max(reach, (surface.vertices.col(v) - centre).cross(line).norm());
    const double off_line = std::sqrt(std::max(axes.eigenvalues()[0] + axes.eigenvalues()[1], 0.0));
    if (off_line * kWeakLever > reach || off_line < 1e-12 * reach) return {};  // the latter is not held at all
    return {"constraints: lie almost on one line near " + readable_point(centre) +
            ", so the body can hardly resist turning about it: an error of a handle is amplified " +
            readable_number(reach / off_line) + " times. Constrain a vertex farther from the line."};
}

}  // namespace elastolab
