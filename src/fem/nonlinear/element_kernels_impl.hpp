#pragma once

// Element integrals for a vector type B of several doubles, or one double. Included by one source per instruction set
// and by nothing else; everything lives in an unnamed namespace, so that no function compiled for one instruction set
// can be linked into code for another.

#include <cmath>
#include <xsimd/xsimd.hpp>

#include "fem/nonlinear/element_kernels.hpp"

namespace elastolab {
namespace {

template <class B>
struct PackLanes {
    static constexpr int kCount = static_cast<int>(B::size);
    static B load(const double* p) { return B::load_unaligned(p); }
    static void store(double* p, const B& value) { value.store_unaligned(p); }
    static B log1p(const B& x) { return xsimd::log1p(x); }
    static B least(const B& a, const B& b) { return xsimd::min(a, b); }
    /// a where |x| < bound, else b.
    static B if_small(const B& x, double bound, const B& a, const B& b) {
        return xsimd::select(xsimd::abs(x) < B(bound), a, b);
    }
};
template <>
struct PackLanes<double> {
    static constexpr int kCount = 1;
    static double load(const double* p) { return *p; }
    static void store(double* p, double value) { *p = value; }
    static double log1p(double x) { return std::log1p(x); }
    static double least(double a, double b) { return a < b ? a : b; }
    static double if_small(double x, double bound, double a, double b) { return std::abs(x) < bound ? a : b; }
};

/// x - ln(1 + x) to 1e-14 of it: by its series where x is small, where the plain difference keeps no digits.
template <class B>
B less_log1p(const B& x, const B& log1p_x) {
    constexpr double kSmall = 0.02;
    B sum = B(1.0 / 9.0);
    for (int k = 8; k >= 2; --k) sum = B(1.0 / k) - x * sum;
    return PackLanes<B>::if_small(x, kSmall, x * x * sum, x - log1p_x);
}

inline constexpr int kEdgeEnds[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

template <class B>
struct Triple {
    B v[3];
    B dot(const Triple& other) const { return v[0] * other.v[0] + v[1] * other.v[1] + v[2] * other.v[2]; }
};

/// The state at one Gauss point.
template <class B, int n>
struct PackPoint {
    Triple<B> rest[n];     ///< gradients of the shape functions in the rest state
    Triple<B> present[n];  ///< in the present one: F^-T rest
    B H[3][3];             ///< displacement gradient
    B j, ln_J, J;          ///< J - 1, ln J, J
    B j_beyond_trace;      ///< j - tr H
    B weight;              ///< volume

    void set_rest(const ElementPack& pack, int lane, int point) {
        Triple<B> corner[4];
        for (int c = 0; c < 4; ++c)
            for (int i = 0; i < 3; ++i) corner[c].v[i] = PackLanes<B>::load(&pack.gradients[c][i][lane]);
        weight = PackLanes<B>::load(&pack.volume[lane]);
        if constexpr (n == 4) {
            for (int c = 0; c < 4; ++c) rest[c] = corner[c];
        } else {
            weight = weight * 0.25;
            const auto L = [&](int c) { return c == point ? kGaussNear : kGaussFar; };
            for (int c = 0; c < 4; ++c)
                for (int i = 0; i < 3; ++i) rest[c].v[i] = (4.0 * L(c) - 1.0) * corner[c].v[i];
            for (int e = 0; e < 6; ++e) {
                const int a = kEdgeEnds[e][0], b = kEdgeEnds[e][1];
                for (int i = 0; i < 3; ++i)
                    rest[4 + e].v[i] = (4.0 * L(b)) * corner[a].v[i] + (4.0 * L(a)) * corner[b].v[i];
            }
        }
    }

    /// sum_a u_a rest_a^T
    void gradient(const double* u, int lane, B (&G)[3][3]) const {
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) G[i][k] = B(0.0);
        for (int a = 0; a < n; ++a)
            for (int i = 0; i < 3; ++i) {
                const B u_ai = PackLanes<B>::load(u + (3 * a + i) * kPack + lane);
                for (int k = 0; k < 3; ++k) G[i][k] = G[i][k] + u_ai * rest[a].v[k];
            }
    }

    void deform(const double* u, int lane) {
        gradient(u, lane, H);
        const B trace = H[0][0] + H[1][1] + H[2][2];
        // Sum of the principal 2 x 2 minors, and the determinant.
        const B minors = H[0][0] * H[1][1] - H[0][1] * H[1][0] + H[1][1] * H[2][2] - H[1][2] * H[2][1] +
                         H[0][0] * H[2][2] - H[0][2] * H[2][0];
        const B determinant = H[0][0] * (H[1][1] * H[2][2] - H[1][2] * H[2][1]) -
                              H[0][1] * (H[1][0] * H[2][2] - H[1][2] * H[2][0]) +
                              H[0][2] * (H[1][0] * H[2][1] - H[1][1] * H[2][0]);
        j_beyond_trace = minors + determinant;
        j = trace + j_beyond_trace;
        J = 1.0 + j;
        ln_J = PackLanes<B>::log1p(j);
    }

    /// What derivatives need.
    void differentiate() {
        B F[3][3];
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) F[i][k] = i == k ? 1.0 + H[i][k] : H[i][k];
        const B inverse_J = B(1.0) / J;
        B T[3][3];  // F^-T: cofactors over J
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) {
                const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
                T[i][k] = (F[i1][k1] * F[i2][k2] - F[i1][k2] * F[i2][k1]) * inverse_J;
            }
        for (int a = 0; a < n; ++a)
            for (int i = 0; i < 3; ++i)
                present[a].v[i] = T[i][0] * rest[a].v[0] + T[i][1] * rest[a].v[1] + T[i][2] * rest[a].v[2];
    }

    B energy(double mu, double lambda) const {
        B square = B(0.0);
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) square = square + H[i][k] * H[i][k];
        return weight *
               (0.5 * mu * (square - 2.0 * j_beyond_trace + 2.0 * less_log1p(j, ln_J)) + 0.5 * lambda * (ln_J * ln_J));
    }

    /// tau, the Kirchhoff stress, times the weight.
    void kirchhoff(double mu, double lambda, B (&tau)[3][3]) const {
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) {
                const B square = H[i][0] * H[k][0] + H[i][1] * H[k][1] + H[i][2] * H[k][2];
                tau[i][k] = weight * (mu * (H[i][k] + H[k][i] + square));
            }
        for (int i = 0; i < 3; ++i) tau[i][i] = tau[i][i] + weight * (lambda * ln_J);
    }
};

template <class B>
void add_to(double* target, const B& value) {
    PackLanes<B>::store(target, PackLanes<B>::load(target) + value);
}

template <class B, int n>
void add_forces(const PackPoint<B, n>& at, double mu, double lambda, int lane, double* forces) {
    B tau[3][3];
    at.kirchhoff(mu, lambda, tau);
    for (int a = 0; a < n; ++a)
        for (int i = 0; i < 3; ++i)
            add_to<B>(forces + (3 * a + i) * kPack + lane,
                      tau[i][0] * at.present[a].v[0] + tau[i][1] * at.present[a].v[1] + tau[i][2] * at.present[a].v[2]);
}

template <class B, int n>
void add_stiffness(const PackPoint<B, n>& at, double mu, double lambda, int lane, double* stiffness) {
    const B c = at.weight * (mu - lambda * at.ln_J), m = at.weight * mu, l = at.weight * lambda;
    for (int a = 0; a < n; ++a) {
        Triple<B> cross, along;
        for (int i = 0; i < 3; ++i) {
            cross.v[i] = c * at.present[a].v[i];
            along.v[i] = l * at.present[a].v[i];
        }
        for (int b = 0; b <= a; ++b) {
            const B same = m * at.rest[a].dot(at.rest[b]);
            for (int k = 0; k < 3; ++k)
                for (int i = 0; i < 3; ++i) {
                    B entry = cross.v[k] * at.present[b].v[i] + along.v[i] * at.present[b].v[k];
                    if (i == k) entry = entry + same;
                    add_to<B>(stiffness + (3 * k + i) * kPack + lane, entry);
                }
            stiffness += 9 * kPack;
        }
    }
}

/// K d = mu D g + c L^T g' + lambda tr(L) g', with D the gradient of d and L = D F^-1 the present one.
template <class B, int n>
void add_force_change(const PackPoint<B, n>& at, double mu, double lambda, int lane, const PackResult& result) {
    const B c = at.weight * (mu - lambda * at.ln_J), m = at.weight * mu, l = at.weight * lambda;
    B D[3][3], L[3][3];
    at.gradient(result.change, lane, D);
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) L[i][k] = B(0.0);
    for (int a = 0; a < n; ++a)
        for (int i = 0; i < 3; ++i) {
            const B d = PackLanes<B>::load(result.change + (3 * a + i) * kPack + lane);
            for (int k = 0; k < 3; ++k) L[i][k] = L[i][k] + d * at.present[a].v[k];
        }
    const B trace = L[0][0] + L[1][1] + L[2][2];
    for (int a = 0; a < n; ++a)
        for (int i = 0; i < 3; ++i) {
            B value = l * trace * at.present[a].v[i];
            for (int k = 0; k < 3; ++k)
                value = value + m * D[i][k] * at.rest[a].v[k] + c * L[k][i] * at.present[a].v[k];
            add_to<B>(result.force_change + (3 * a + i) * kPack + lane, value);
        }
}

inline void clear(double* values, int n_numbers) {
    if (values == nullptr) return;
    for (int i = 0; i < n_numbers * kPack; ++i) values[i] = 0.0;
}

template <class B, int n>
void evaluate(const ElementPack& pack, const double* u, double mu, double lambda, const PackResult& result) {
    clear(result.energy, 1);
    clear(result.forces, 3 * n);
    clear(result.stiffness, 9 * n * (n + 1) / 2);
    clear(result.force_change, 3 * n);
    const bool derivatives = result.forces != nullptr || result.stiffness != nullptr || result.change != nullptr;
    for (int lane = 0; lane < kPack; lane += PackLanes<B>::kCount) {
        B least_J = B(1e300);
        for (int point = 0; point < (n == 4 ? 1 : 4); ++point) {
            PackPoint<B, n> at;
            at.set_rest(pack, lane, point);
            at.deform(u, lane);
            least_J = PackLanes<B>::least(least_J, at.J);
            if (result.energy != nullptr) add_to<B>(result.energy + lane, at.energy(mu, lambda));
            if (!derivatives) continue;
            at.differentiate();
            if (result.forces != nullptr) add_forces(at, mu, lambda, lane, result.forces);
            if (result.stiffness != nullptr) add_stiffness(at, mu, lambda, lane, result.stiffness);
            if (result.change != nullptr) add_force_change(at, mu, lambda, lane, result);
        }
        if (result.least_J != nullptr) PackLanes<B>::store(result.least_J + lane, least_J);
    }
}

template <class B>
constexpr ElementKernels make_element_kernels(const char* name) {
    return {name, evaluate<B, 4>, evaluate<B, 10>};
}

}  // namespace
}  // namespace elastolab
