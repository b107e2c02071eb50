#pragma once

// Moments of the kernels over a triangle, and what they make of a shape function.
// Part of triangle_kernels_impl.hpp, which says why all is in an unnamed namespace.

#include <type_traits>

#include "elasticity/triangle_kernels.hpp"
#include "elasticity/triangle_lanes_impl.hpp"
#include "elasticity/triangle_view_impl.hpp"

namespace elastolab {
namespace {

/// Symmetric tensor in the triangle's frame.
template <class B>
struct LocalTensor {
    B xx, yy, zz, xy, xz, yz;
};

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

/// What the edges, of normal m and direction t in the plane of the triangle, add to moments of rho rho.
template <class B>
struct EdgeSum2 {
    B xx = B(0.0), xy = B(0.0), yy = B(0.0);

    /// m (m a + t b), which is symmetric once summed over the edges.
    template <class S>
    void add(const S& mx, const S& my, const S& tx, const S& ty, const B& a, const B& b) {
        xx += (mx * mx) * a + (mx * tx) * b;
        xy += (mx * my) * a + (mx * ty) * b;
        yy += (my * my) * a + (my * ty) * b;
    }
};

/// The same of rho rho rho.
template <class B>
struct EdgeSum3 {
    B s111 = B(0.0), s112 = B(0.0), s122 = B(0.0), s222 = B(0.0);

    /// m (m m mm + (m t + t m) mt + t t tt).
    template <class S>
    void add(const S& mx, const S& my, const S& tx, const S& ty, const B& mm, const B& mt, const B& tt) {
        const B Wxx = (mx * mx) * mm + (2.0 * mx * tx) * mt + (tx * tx) * tt;
        const B Wxy = (mx * my) * mm + (mx * ty + tx * my) * mt + (tx * ty) * tt;
        const B Wyy = (my * my) * mm + (2.0 * my * ty) * mt + (ty * ty) * tt;
        s111 += mx * Wxx;
        s112 += mx * Wxy;
        s122 += my * Wxy;
        s222 += my * Wyy;
    }
};

/// Moments of 1/r and rho.../r^3 over the triangle: everything that the single layer and the potential need.
template <class B>
struct SingleMoments {
    B z, omega, z_omega, I, Jx, Jy, Nx, Ny, Qxx, Qxy, Qyy;  ///< docs/formulation.md section 3
    B T111, T112, T122, T222;                               ///< int rho rho rho / r^3

    template <bool kHats>
    static SingleMoments of(const Geometry<B>& T, const View<B>& v, std::bool_constant<kHats>) {
        SingleMoments M;
        const B zero(0.0);
        M.z = v.z;
        M.omega = solid_angle(T, v);
        M.z_omega = v.z * M.omega;
        M.I = -M.z_omega;
        M.Nx = M.Ny = M.Jx = M.Jy = zero;
        EdgeSum2<B> S;
        EdgeSum3<B> W;
        for (int i = 0; i < 3; ++i) {
            const EdgeTerms<B> e = edge_terms(T, v, i);
            const auto tx = T.tx[i], ty = T.ty[i], mx = ty, my = -tx;
            const B hL = e.h * e.L, R2L = e.R2 * e.L;
            M.I += hL;
            M.Nx -= mx * e.L;
            M.Ny -= my * e.L;
            S.add(mx, my, tx, ty, hL, e.dr);
            if constexpr (kHats) {
                const B j = 0.5 * (e.dsr + R2L);
                M.Jx += mx * j;
                M.Jy += my * j;
                W.add(mx, my, tx, ty, e.h * hL, e.h * e.dr, 0.5 * (e.dsr - R2L));
            }
        }
        M.Qxx = M.I - S.xx;
        M.Qxy = -S.xy;
        M.Qyy = M.I - S.yy;
        if constexpr (kHats) {
            M.T111 = 2.0 * M.Jx - W.s111;
            M.T112 = M.Jy - W.s112;
            M.T122 = M.Jx - W.s122;
            M.T222 = 2.0 * M.Jy - W.s222;
        }
        return M;
    }

    /// int phi z / r^3.
    B normal(const Shape<B>& p) const { return p.f * omega + z * (Nx * p.gx + Ny * p.gy); }

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

    template <bool kHats>
    static DoubleMoments of(const Geometry<B>& T, const View<B>& v, std::bool_constant<kHats>) {
        DoubleMoments M;
        const B zero(0.0);
        M.z = v.z;
        M.omega = solid_angle(T, v);
        B I = -v.z * M.omega;
        M.Nx = M.Ny = zero;
        B hC = zero, mxC = zero, myC = zero;
        EdgeSum2<B> Q, Y;
        EdgeSum3<B> V;
        for (int i = 0; i < 3; ++i) {
            const EdgeTerms<B> e = edge_terms(T, v, i);
            const auto tx = T.tx[i], ty = T.ty[i], mx = ty, my = -tx;
            const B hc = e.h * e.C;
            M.Nx -= mx * e.L;
            M.Ny -= my * e.L;
            hC += hc;
            mxC += mx * e.C;
            myC += my * e.C;
            Y.add(mx, my, tx, ty, hc, e.D);
            if constexpr (kHats) {
                const B hL = e.h * e.L;
                I += hL;
                Q.add(mx, my, tx, ty, hL, e.dr);
                V.add(mx, my, tx, ty, e.h * hc, e.h * e.D, e.L - e.R2 * e.C);
            }
        }
        const B z2 = v.z * v.z;
        M.Pzz = M.omega + v.z * hC;
        M.Px = -z2 * mxC;
        M.Py = -z2 * myC;
        M.Yxx = M.omega - v.z * Y.xx;
        M.Yxy = -v.z * Y.xy;
        M.Yyy = M.omega - v.z * Y.yy;
        if constexpr (kHats) {
            M.Qxx = I - Q.xx;
            M.Qxy = -Q.xy;
            M.Qyy = I - Q.yy;
            M.R111 = 2.0 * M.Nx - V.s111;
            M.R112 = M.Ny - V.s112;
            M.R122 = M.Nx - V.s122;
            M.R222 = 2.0 * M.Ny - V.s222;
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

}  // namespace
}  // namespace elastolab
