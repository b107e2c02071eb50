#pragma once

// Closed forms of docs/formulation.md section 3, for a vector type B of several doubles (or one double, or one long
// double). Included by one source per instruction set and by nothing else; everything lives in an unnamed namespace, so
// that no function compiled for one instruction set can be linked into code for another.

#include <cmath>
#include <concepts>
#include <xsimd/xsimd.hpp>

#include "elasticity/sliver_kernels.hpp"
#include "elasticity/triangle_kernels.hpp"

namespace elastolab {
namespace {

template <class B>
struct Lanes {
    using Number = double;
    static constexpr int kCount = static_cast<int>(B::size);
    static B load(const double* p) { return B::load_unaligned(p); }
    static void add(double* p, const B& value) { (B::load_unaligned(p) + value).store_unaligned(p); }
};

template <std::floating_point Real>
struct Lanes<Real> {
    using Number = Real;
    static constexpr int kCount = 1;
    static Real load(const double* p) { return *p; }
    static void add(double* p, Real value) { *p += static_cast<double>(value); }
};

/// A triangle, in the precision of B.
template <class B>
using Geometry = BasicTriangleGeometry<typename Lanes<B>::Number>;

/// a where the mask holds, else b.
template <class Mask, class B>
B pick(const Mask& mask, const B& a, const B& b) {
    return xsimd::select(mask, a, b);
}
template <std::floating_point B>
B pick(const bool& mask, const B& a, const B& b) {
    return mask ? a : b;
}
template <class B>
B square_root(const B& x) {
    using std::sqrt, xsimd::sqrt;
    return sqrt(x);
}
template <class B>
B logarithm(const B& x) {
    using std::log, xsimd::log;
    return log(x);
}
template <class B>
B arc_tangent(const B& y, const B& x) {
    using std::atan2, xsimd::atan2;
    return atan2(y, x);
}
template <class Mask>
Mask either(const Mask& a, const Mask& b) {
    return a | b;
}

/// Symmetric tensor in the triangle's frame.
template <class B>
struct LocalTensor {
    B xx, yy, zz, xy, xz, yz;
};

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

/// Adds p u^T + q v^T + n w^T, the tensor `S` turned into the global frame, to six numbers of `lanes` each.
template <class B>
void add_tensor(const Geometry<B>& T, const LocalTensor<B>& S, double* out) {
    B u[3], v[3], w[3];
    for (int i = 0; i < 3; ++i) {
        u[i] = S.xx * T.e1[i] + S.xy * T.e2[i] + S.xz * T.n[i];
        v[i] = S.xy * T.e1[i] + S.yy * T.e2[i] + S.yz * T.n[i];
        w[i] = S.xz * T.e1[i] + S.yz * T.e2[i] + S.zz * T.n[i];
    }
    constexpr int kRow[6] = {0, 1, 2, 0, 0, 1}, kColumn[6] = {0, 1, 2, 1, 2, 2};
    for (int k = 0; k < 6; ++k) {
        const int i = kRow[k], j = kColumn[k];
        Lanes<B>::add(out + k * Lanes<B>::kCount, T.e1[i] * u[j] + T.e2[i] * v[j] + T.n[i] * w[j]);
    }
}

/// Single-layer block of one shape function.
template <class B>
struct SingleBlock {
    B s;
    LocalTensor<B> S;
    void add_to(const Geometry<B>& T, double* out) const {
        Lanes<B>::add(out, s);
        add_tensor(T, S, out + Lanes<B>::kCount);
    }
};

/// Double-layer block of one shape function; (wx, wy) = int phi rho / r^3.
template <class B>
struct DoubleBlock {
    B a, wx, wy;
    LocalTensor<B> S;
    void add_to(const Geometry<B>& T, double* out) const {
        Lanes<B>::add(out, a);
        for (int i = 0; i < 3; ++i)  // c = w x n
            Lanes<B>::add(out + (1 + i) * Lanes<B>::kCount, wy * T.e1[i] - wx * T.e2[i]);
        add_tensor(T, S, out + 4 * Lanes<B>::kCount);
    }
};

/// The last shape function is the constant one less the two others: f0 = 1 - f1 - f2, g0 = -g1 - g2.
template <class B>
LocalTensor<B> remainder(const LocalTensor<B>& a, const LocalTensor<B>& b, const LocalTensor<B>& c) {
    return {a.xx - b.xx - c.xx, a.yy - b.yy - c.yy, a.zz - b.zz - c.zz,
            a.xy - b.xy - c.xy, a.xz - b.xz - c.xz, a.yz - b.yz - c.yz};
}
template <class B>
SingleBlock<B> remainder(const SingleBlock<B>& a, const SingleBlock<B>& b, const SingleBlock<B>& c) {
    return {a.s - b.s - c.s, remainder(a.S, b.S, c.S)};
}
template <class B>
DoubleBlock<B> remainder(const DoubleBlock<B>& a, const DoubleBlock<B>& b, const DoubleBlock<B>& c) {
    return {a.a - b.a - c.a, a.wx - b.wx - c.wx, a.wy - b.wy - c.wy, remainder(a.S, b.S, c.S)};
}

/// Value f and gradient g of shape function k at the projection of x: phi_k = f + g . rho.
template <class B>
struct Shape {
    Shape(const Geometry<B>& T, const View<B>& v, int k)
        : gx(T.gx[k]), gy(T.gy[k]), f((k == 0 ? 1.0 : 0.0) - (v.px[0] * gx + v.py[0] * gy)) {}
    typename Lanes<B>::Number gx, gy;
    B f;
};

/// Moments of 1/r and rho.../r^3 over the triangle: everything that the single layer needs.
template <class B>
struct SingleMoments {
    B z, z_omega, I, Jx, Jy, Nx, Ny, Qxx, Qxy, Qyy;  ///< docs/formulation.md section 3
    B T111, T112, T122, T222;                        ///< int rho rho rho / r^3

    template <bool kLinear>
    static SingleMoments of(const Geometry<B>& T, const View<B>& v, std::bool_constant<kLinear>) {
        SingleMoments M;
        const B zero(0.0);
        M.z = v.z;
        M.z_omega = v.z * solid_angle(T, v);
        M.I = -M.z_omega;
        M.Nx = M.Ny = M.Jx = M.Jy = zero;
        B sxx = zero, sxy = zero, syy = zero, s111 = zero, s112 = zero, s122 = zero, s222 = zero;
        for (int i = 0; i < 3; ++i) {
            const EdgeTerms<B> e = edge_terms(T, v, i);
            const auto tx = T.tx[i], ty = T.ty[i], mx = ty, my = -tx;
            const B hL = e.h * e.L, R2L = e.R2 * e.L;
            M.I += hL;
            M.Nx -= mx * e.L;
            M.Ny -= my * e.L;
            sxx += (mx * mx) * hL + (mx * tx) * e.dr;
            sxy += (mx * my) * hL + (mx * ty) * e.dr;
            syy += (my * my) * hL + (my * ty) * e.dr;
            if constexpr (kLinear) {
                const B j = 0.5 * (e.dsr + R2L);
                M.Jx += mx * j;
                M.Jy += my * j;
                const B mm = e.h * hL, mt = e.h * e.dr, tt = 0.5 * (e.dsr - R2L);
                const B Wxx = (mx * mx) * mm + (2.0 * mx * tx) * mt + (tx * tx) * tt;
                const B Wxy = (mx * my) * mm + (mx * ty + tx * my) * mt + (tx * ty) * tt;
                const B Wyy = (my * my) * mm + (2.0 * my * ty) * mt + (ty * ty) * tt;
                s111 += mx * Wxx;
                s112 += mx * Wxy;
                s122 += my * Wxy;
                s222 += my * Wyy;
            }
        }
        M.Qxx = M.I - sxx;
        M.Qxy = -sxy;
        M.Qyy = M.I - syy;
        if constexpr (kLinear) {
            M.T111 = 2.0 * M.Jx - s111;
            M.T112 = M.Jy - s112;
            M.T122 = M.Jx - s122;
            M.T222 = 2.0 * M.Jy - s222;
        }
        return M;
    }

    SingleBlock<B> constant() const { return {I, {Qxx, Qyy, z_omega, Qxy, z * Nx, z * Ny}}; }

    SingleBlock<B> linear(const Shape<B>& p) const {
        return {p.f * I + Jx * p.gx + Jy * p.gy,
                {p.f * Qxx + T111 * p.gx + T112 * p.gy, p.f * Qyy + T122 * p.gx + T222 * p.gy,
                 p.f * z_omega + z * z * (Nx * p.gx + Ny * p.gy), p.f * Qxy + T112 * p.gx + T122 * p.gy,
                 z * (p.f * Nx + Qxx * p.gx + Qxy * p.gy), z * (p.f * Ny + Qxy * p.gx + Qyy * p.gy)}};
    }
};

/// Moments of rho.../r^3 and 3 z rho.../r^5 over the triangle: everything that the double layer needs.
template <class B>
struct DoubleMoments {
    B z, omega, Nx, Ny, Qxx, Qxy, Qyy;
    B Pzz;                     ///< 3 z^3 int 1/r^5
    B Px, Py;                  ///< 3 z^2 int rho/r^5
    B Yxx, Yxy, Yyy;           ///< 3 z int rho rho/r^5
    B R111, R112, R122, R222;  ///< 3 int rho rho rho/r^5

    template <bool kLinear>
    static DoubleMoments of(const Geometry<B>& T, const View<B>& v, std::bool_constant<kLinear>) {
        DoubleMoments M;
        const B zero(0.0);
        M.z = v.z;
        M.omega = solid_angle(T, v);
        B I = -v.z * M.omega;
        M.Nx = M.Ny = zero;
        B hC = zero, mxC = zero, myC = zero, qxx = zero, qxy = zero, qyy = zero, yxx = zero, yxy = zero, yyy = zero;
        B s111 = zero, s112 = zero, s122 = zero, s222 = zero;
        for (int i = 0; i < 3; ++i) {
            const EdgeTerms<B> e = edge_terms(T, v, i);
            const auto tx = T.tx[i], ty = T.ty[i], mx = ty, my = -tx;
            const B hc = e.h * e.C;
            M.Nx -= mx * e.L;
            M.Ny -= my * e.L;
            hC += hc;
            mxC += mx * e.C;
            myC += my * e.C;
            yxx += (mx * mx) * hc + (mx * tx) * e.D;
            yxy += (mx * my) * hc + (mx * ty) * e.D;
            yyy += (my * my) * hc + (my * ty) * e.D;
            if constexpr (kLinear) {
                const B hL = e.h * e.L;
                I += hL;
                qxx += (mx * mx) * hL + (mx * tx) * e.dr;
                qxy += (mx * my) * hL + (mx * ty) * e.dr;
                qyy += (my * my) * hL + (my * ty) * e.dr;
                const B mm = e.h * hc, mt = e.h * e.D, tt = e.L - e.R2 * e.C;
                const B Vxx = (mx * mx) * mm + (2.0 * mx * tx) * mt + (tx * tx) * tt;
                const B Vxy = (mx * my) * mm + (mx * ty + tx * my) * mt + (tx * ty) * tt;
                const B Vyy = (my * my) * mm + (2.0 * my * ty) * mt + (ty * ty) * tt;
                s111 += mx * Vxx;
                s112 += mx * Vxy;
                s122 += my * Vxy;
                s222 += my * Vyy;
            }
        }
        const B z2 = v.z * v.z;
        M.Pzz = M.omega + v.z * hC;
        M.Px = -z2 * mxC;
        M.Py = -z2 * myC;
        M.Yxx = M.omega - v.z * yxx;
        M.Yxy = -v.z * yxy;
        M.Yyy = M.omega - v.z * yyy;
        if constexpr (kLinear) {
            M.Qxx = I - qxx;
            M.Qxy = -qxy;
            M.Qyy = I - qyy;
            M.R111 = 2.0 * M.Nx - s111;
            M.R112 = M.Ny - s112;
            M.R122 = M.Nx - s122;
            M.R222 = 2.0 * M.Ny - s222;
        }
        return M;
    }

    DoubleBlock<B> constant() const { return {omega, Nx, Ny, {Yxx, Yyy, Pzz, Yxy, Px, Py}}; }

    DoubleBlock<B> linear(const Shape<B>& p) const {
        return {p.f * omega + z * (Nx * p.gx + Ny * p.gy),
                p.f * Nx + Qxx * p.gx + Qxy * p.gy,
                p.f * Ny + Qxy * p.gx + Qyy * p.gy,
                {p.f * Yxx + z * (R111 * p.gx + R112 * p.gy), p.f * Yyy + z * (R122 * p.gx + R222 * p.gy),
                 p.f * Pzz + z * (Px * p.gx + Py * p.gy), p.f * Yxy + z * (R112 * p.gx + R122 * p.gy),
                 p.f * Px + z * (Yxx * p.gx + Yxy * p.gy), p.f * Py + z * (Yxy * p.gx + Yyy * p.gy)}};
    }
};

template <class B, class Moments, bool kLinear>
void closed_form(const Geometry<B>& T, const SourceLanes& sources, double* const* out) {
    const View<B> view = view_from<B>(T, sources);
    const Moments moments = Moments::of(T, view, std::bool_constant<kLinear>{});
    const auto whole = moments.constant();
    if constexpr (kLinear) {
        const auto first = moments.linear(Shape<B>(T, view, 1)), second = moments.linear(Shape<B>(T, view, 2));
        remainder(whole, first, second).add_to(T, out[0]);
        first.add_to(T, out[1]);
        second.add_to(T, out[2]);
    } else {
        whole.add_to(T, out[0]);
    }
}

/// The kernel at one point, times weight: 7 or 10 numbers in the global frame; d = y - x.
template <class B>
void point_values(const TriangleGeometry&, const B (&d)[3], const B& inverse_r, double weight,
                  B (&values)[kSingleLayerNumbers]) {
    const B inverse_r3 = weight * inverse_r * inverse_r * inverse_r;
    values[0] = weight * inverse_r;
    constexpr int kRow[6] = {0, 1, 2, 0, 0, 1}, kColumn[6] = {0, 1, 2, 1, 2, 2};
    for (int k = 0; k < 6; ++k) values[1 + k] = inverse_r3 * d[kRow[k]] * d[kColumn[k]];
}
template <class B>
void point_values(const TriangleGeometry& T, const B (&d)[3], const B& inverse_r, double weight,
                  B (&values)[kDoubleLayerNumbers]) {
    const B inverse_r2 = inverse_r * inverse_r, inverse_r3 = weight * inverse_r * inverse_r2;
    const B z = d[0] * T.n[0] + d[1] * T.n[1] + d[2] * T.n[2];
    values[0] = z * inverse_r3;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        values[1 + i] = inverse_r3 * (d[j] * T.n[k] - d[k] * T.n[j]);
    }
    constexpr int kRow[6] = {0, 1, 2, 0, 0, 1}, kColumn[6] = {0, 1, 2, 1, 2, 2};
    const B factor = 3.0 * values[0] * inverse_r2;
    for (int k = 0; k < 6; ++k) values[4 + k] = factor * d[kRow[k]] * d[kColumn[k]];
}

template <class B, int kNumbers, bool kLinear>
void gauss(const TriangleGeometry& T, const SourceLanes& sources, const GaussRule& rule, double* const* out) {
    constexpr int kShapes = kLinear ? 3 : 1;
    const B x[3] = {Lanes<B>::load(sources.x), Lanes<B>::load(sources.y), Lanes<B>::load(sources.z)};
    B sums[kShapes][kNumbers];
    for (auto& shape : sums)
        for (B& number : shape) number = B(0.0);
    for (int q = 0; q < rule.n_points; ++q) {
        const double* phi = rule.points[q].data();
        B d[3], values[kNumbers];
        for (int i = 0; i < 3; ++i)
            d[i] = (phi[0] * T.corner[0][i] + phi[1] * T.corner[1][i] + phi[2] * T.corner[2][i]) - x[i];
        const B inverse_r = B(1.0) / square_root(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        point_values(T, d, inverse_r, 0.5 * T.double_area * rule.weights[q], values);
        for (int shape = 0; shape < kShapes; ++shape)
            for (int k = 0; k < kNumbers; ++k) sums[shape][k] += (kLinear ? phi[shape] : 1.0) * values[k];
    }
    for (int shape = 0; shape < kShapes; ++shape)
        for (int k = 0; k < kNumbers; ++k) Lanes<B>::add(out[shape] + k * Lanes<B>::kCount, sums[shape][k]);
}

inline bool is_sliver(const TriangleGeometry& T) {
    return T.double_area < kSliverAltitude * T.longest_edge * T.longest_edge;
}

template <class B, bool kLinear>
void single_layer(const TriangleGeometry& T, const SourceLanes& sources, const GaussRule* rule, double* const* out) {
    if (rule != nullptr) return gauss<B, kSingleLayerNumbers, kLinear>(T, sources, *rule, out);
    if (is_sliver(T)) return add_single_layer_of_sliver(T, sources, Lanes<B>::kCount, kLinear, out);
    closed_form<B, SingleMoments<B>, kLinear>(T, sources, out);
}

template <class B, bool kLinear>
void double_layer(const TriangleGeometry& T, const SourceLanes& sources, const GaussRule* rule, double* const* out) {
    if (rule != nullptr) return gauss<B, kDoubleLayerNumbers, kLinear>(T, sources, *rule, out);
    if (is_sliver(T)) return add_double_layer_of_sliver(T, sources, Lanes<B>::kCount, kLinear, out);
    closed_form<B, DoubleMoments<B>, kLinear>(T, sources, out);
}

template <class B>
constexpr TriangleKernels make_kernels(const char* name) {
    return {name,
            Lanes<B>::kCount,
            &single_layer<B, true>,
            &single_layer<B, false>,
            &double_layer<B, true>,
            &double_layer<B, false>};
}

}  // namespace
}  // namespace elastolab
