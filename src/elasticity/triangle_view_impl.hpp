#pragma once

// A triangle seen from some sources: its corners, its edges and its solid angle.
// Part of triangle_kernels_impl.hpp, which says why all is in an unnamed namespace.

#include "elasticity/triangle_kernels.hpp"
#include "elasticity/triangle_lanes_impl.hpp"

namespace elastolab {
namespace {

/// What one edge contributes (docs/formulation.md section 3): h, R^2, L, C, D, [r], [s r].
template <class B>
struct EdgeTerms {
    B h, R2, L, C, D, dr, dsr;
};

/// Corners seen from the sources, in the triangle's frame.
template <class B>
struct View {
    B px[3], py[3];  ///< in-plane parts of corner - x
    B z;             ///< (corner - x) . n, zero when x is a corner or in the interior
    B r[3];          ///< distances of the corners
    B on_plane;      ///< 1 where x is a corner or in the interior, else 0
};

template <class B>
View<B> view_from(const Geometry<B>& T, const SourceLanes& sources) {
    const B x = Lanes<B>::load(sources.x), y = Lanes<B>::load(sources.y), z = Lanes<B>::load(sources.z);
    View<B> view;
    for (int i = 0; i < 3; ++i) {
        const B dx = T.corner[i][0] - x, dy = T.corner[i][1] - y, dz = T.corner[i][2] - z;
        view.px[i] = dx * T.e1[0] + dy * T.e1[1] + dz * T.e1[2];
        view.py[i] = dx * T.e2[0] + dy * T.e2[1] + dz * T.e2[2];
        view.r[i] = square_root(dx * dx + dy * dy + dz * dz);
        if (i == 0) view.z = dx * T.n[0] + dy * T.n[1] + dz * T.n[2];
    }
    const B zero(0.0), one(1.0);
    const auto corner = either(either(view.r[0] == zero, view.r[1] == zero), view.r[2] == zero);
    const auto interior = Lanes<B>::load(sources.own_triangle) == B(static_cast<double>(T.index));
    view.on_plane = pick(either(corner, interior), one, zero);
    view.z = pick(view.on_plane == one, zero, view.z);
    return view;
}

/// Signed solid angle [Van Oosterom and Strackee]; the triple product of the corners is z times twice the area.
template <class B>
B solid_angle(const Geometry<B>& T, const View<B>& v) {
    const auto dot = [&](int i, int j) { return v.px[i] * v.px[j] + v.py[i] * v.py[j] + v.z * v.z; };
    const B denominator = v.r[0] * v.r[1] * v.r[2] + dot(0, 1) * v.r[2] + dot(1, 2) * v.r[0] + dot(2, 0) * v.r[1];
    const B angle = 2.0 * arc_tangent(T.double_area * v.z, denominator);
    return pick(v.on_plane != B(0.0), B(0.0), angle);
}

template <class B>
EdgeTerms<B> edge_terms(const Geometry<B>& T, const View<B>& v, int edge) {
    const int a = edge, b = (edge + 1) % 3;
    const B zero(0.0), one(1.0);
    const auto tx = T.tx[edge], ty = T.ty[edge], l = T.length[edge];
    const auto incident = either(v.r[a] == zero, v.r[b] == zero);
    const B ra = pick(incident, one, v.r[a]), rb = pick(incident, one, v.r[b]);

    EdgeTerms<B> e;
    const B sa = v.px[a] * tx + v.py[a] * ty, sb = v.px[b] * tx + v.py[b] * ty;
    e.h = v.px[a] * ty - v.py[a] * tx;
    e.h = pick(incident, zero, e.h);
    e.R2 = e.h * e.h + v.z * v.z;
    e.dr = v.r[b] - v.r[a];
    e.dsr = sb * v.r[b] - sa * v.r[a];

    // L: away from the edge the quotient is harmless; where the edge is seen at more than a right angle its
    // denominator cancels, and the second form does not.
    const B same_side = e.R2 + sa * sb, sum = ra + rb;
    const auto acute = same_side > zero;
    const B quotient_top = pick(acute, sum + l, (sum + l) * (sum + l) * (ra * rb - same_side));
    const B quotient_bottom = pick(acute, sum - l, (2.0 * l * l) * e.R2);
    // C: the first form has no 0/0 on the extension of the edge.
    const auto outside = sa * sb > zero;
    const B c_top = pick(outside, (sb - sa) * (sb + sa), sb * ra - sa * rb);
    const B c_bottom = pick(outside, sb * ra + sa * rb, e.R2) * ra * rb;
    const B inverse = one / (ra * rb);

    e.L = pick(incident, zero, logarithm(quotient_top / quotient_bottom));
    e.C = pick(incident, zero, c_top / c_bottom);
    e.D = pick(incident, zero, (rb - ra) * inverse);
    return e;
}

}  // namespace
}  // namespace elastolab
