#include "mesh/checks/triangle_contact.hpp"

#include <algorithm>
#include <array>

#include "mesh/checks/predicates.hpp"

namespace elastolab {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

using Corners = std::array<Vector3d, 3>;
using FlatCorners = std::array<Vector2d, 3>;

Vector2d without_axis(const Vector3d& p, int axis) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

FlatCorners without_axis(const Corners& t, int axis) {
    return {without_axis(t[0], axis), without_axis(t[1], axis), without_axis(t[2], axis)};
}

/// An axis along which the triangle can be projected without becoming a line; -1 if it has no area.
int projection_axis(const Corners& t) {
    for (int axis = 2; axis >= 0; --axis) {
        const FlatCorners f = without_axis(t, axis);
        if (orientation(f[0], f[1], f[2]) != 0) return axis;
    }
    return -1;
}

bool in_closed_triangle(const Vector2d& p, const FlatCorners& t) {
    const std::array<int, 3> s{orientation(t[0], t[1], p), orientation(t[1], t[2], p), orientation(t[2], t[0], p)};
    return std::none_of(s.begin(), s.end(), [](int x) { return x < 0; }) ||
           std::none_of(s.begin(), s.end(), [](int x) { return x > 0; });
}

bool in_box(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
    return (p.array() >= a.array().min(b.array())).all() && (p.array() <= a.array().max(b.array())).all();
}

bool segments_meet(const Vector2d& p, const Vector2d& q, const Vector2d& a, const Vector2d& b) {
    const int pa = orientation(p, q, a), pb = orientation(p, q, b), ap = orientation(a, b, p),
              aq = orientation(a, b, q);
    if (pa * pb < 0 && ap * aq < 0) return true;
    return (pa == 0 && in_box(a, p, q)) || (pb == 0 && in_box(b, p, q)) || (ap == 0 && in_box(p, a, b)) ||
           (aq == 0 && in_box(q, a, b));
}

bool meet_in_plane(const Vector3d& p, const Vector3d& q, const Corners& t) {
    const int axis = projection_axis(t);
    const Vector2d fp = without_axis(p, axis), fq = without_axis(q, axis);
    const FlatCorners f = without_axis(t, axis);
    return in_closed_triangle(fp, f) || segments_meet(fp, fq, f[0], f[1]) || segments_meet(fp, fq, f[1], f[2]) ||
           segments_meet(fp, fq, f[2], f[0]);
}

/// Whether the closed segment p q, whose ends lie on these sides of the triangle's plane, meets the closed triangle.
bool segment_meets(const Vector3d& p, const Vector3d& q, int side_p, int side_q, const Corners& t) {
    if (side_p * side_q > 0) return false;
    if (side_p == 0 && side_q == 0) return meet_in_plane(p, q, t);
    const int s0 = orientation(p, q, t[0], t[1]), s1 = orientation(p, q, t[1], t[2]);
    if (s0 * s1 < 0) return false;
    const int s2 = orientation(p, q, t[2], t[0]);
    return s0 * s2 >= 0 && s1 * s2 >= 0;
}

std::array<int, 3> sides(const Corners& plane, const Corners& t) {
    std::array<int, 3> result{};
    for (std::size_t i = 0; i < 3; ++i) result[i] = orientation(plane[0], plane[1], plane[2], t[i]);
    return result;
}

bool all_on_one_side(const std::array<int, 3>& side) {
    return side[0] != 0 && side[0] == side[1] && side[1] == side[2];
}

bool strangers_meet(const Corners& a, const Corners& b) {
    const std::array<int, 3> sa = sides(b, a);
    if (all_on_one_side(sa)) return false;
    const std::array<int, 3> sb = sides(a, b);
    if (all_on_one_side(sb)) return false;
    for (std::size_t i = 0, j = 2; i < 3; j = i++)
        if (segment_meets(a[i], a[j], sa[i], sa[j], b) || segment_meets(b[i], b[j], sb[i], sb[j], a)) return true;
    return false;
}

/// Whether a plane through the common first corner has the rest of both strictly on its two sides: a test without exact
/// arithmetic, which knows most of the many pairs around one vertex apart. The plane need not be exact; a side is
/// believed where it is far above the rounding of a product of three terms and of the differences in it.
bool parted_by_plane(const Corners& a, const Corners& b) {
    constexpr double kRounding = 1e-14;
    const std::array<Vector3d, 4> edges{a[1] - a[0], a[2] - a[0], b[1] - b[0], b[2] - b[0]};
    std::array<double, 4> lengths{};
    for (std::size_t i = 0; i < 4; ++i) lengths[i] = edges[i].norm();
    const Vector3d normal =
        edges[0] / lengths[0] + edges[1] / lengths[1] - edges[2] / lengths[2] - edges[3] / lengths[3];
    const double size = kRounding * normal.norm();
    for (std::size_t i = 0; i < 4; ++i)
        if (!((i < 2 ? 1.0 : -1.0) * normal.dot(edges[i]) > size * lengths[i])) return false;
    return true;
}

/// For a common first corner. If they share more, then by convexity a segment from that corner to an edge opposite it.
bool meet_beyond_corner(const Corners& a, const Corners& b) {
    if (parted_by_plane(a, b)) return false;
    const std::array<int, 3> sa = sides(b, a), sb = sides(a, b);
    return segment_meets(a[1], a[2], sa[1], sa[2], b) || segment_meets(b[1], b[2], sb[1], sb[2], a);
}

/// For common first and second corners. They share more only when they lie in one plane, on the same side of the edge.
bool folded_over_edge(const Corners& a, const Corners& b) {
    if (orientation(a[0], a[1], a[2], b[2]) != 0) return false;
    const FlatCorners fa = without_axis(a, projection_axis(a)), fb = without_axis(b, projection_axis(a));
    return orientation(fa[0], fa[1], fa[2]) == orientation(fb[0], fb[1], fb[2]);
}

}  // namespace

bool in_contact(const SurfaceMesh& mesh, int triangle, int other) {
    Eigen::Vector3i va = mesh.triangles.col(triangle), vb = mesh.triangles.col(other);
    int n_common = 0;  // bring common vertices to the front of both; the order of corners does not matter here
    for (int i = 0; i < 3; ++i)
        for (int j = n_common; j < 3; ++j)
            if (va[i] == vb[j]) {
                std::swap(va[i], va[n_common]);
                std::swap(vb[j], vb[n_common]);
                ++n_common;
                break;
            }
    const auto corners = [&](const Eigen::Vector3i& v) {
        return Corners{mesh.vertices.col(v[0]), mesh.vertices.col(v[1]), mesh.vertices.col(v[2])};
    };
    switch (n_common) {
        case 0:
            return strangers_meet(corners(va), corners(vb));
        case 1:
            return meet_beyond_corner(corners(va), corners(vb));
        case 2:
            return folded_over_edge(corners(va), corners(vb));
        default:
            return false;
    }
}

bool is_degenerate(const Vector3d& a, const Vector3d& b, const Vector3d& c) { return projection_axis({a, b, c}) < 0; }

}  // namespace elastolab
