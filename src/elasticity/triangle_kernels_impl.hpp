#pragma once

// Closed forms of docs/formulation.md section 3, for a vector type B of several doubles (or one double, or one long
// double). Included by one source per instruction set and by nothing else; everything lives in an unnamed namespace, so
// that no function compiled for one instruction set can be linked into code for another.

#include <type_traits>

#include "elasticity/sliver_kernels.hpp"
#include "elasticity/triangle_kernels.hpp"
#include "elasticity/triangle_lanes_impl.hpp"
#include "elasticity/triangle_moments_impl.hpp"
#include "elasticity/triangle_view_impl.hpp"

namespace elastolab {
namespace {

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

template <class B>
void add_potential(const Geometry<B>& T, const SourceLanes& sources, Potential wanted, double* out) {
    constexpr int kLanes = Lanes<B>::kCount;
    const View<B> view = view_from<B>(T, sources);
    const auto M = SingleMoments<B>::of(T, view, std::false_type{});
    add_tensor(T, M.constant().S, out);
    double* const rest = out + kPotentialTensorNumbers * kLanes;
    if (wanted == Potential::with_normals) {
        const B second = M.normal(Shape<B>(T, view, 1)), third = M.normal(Shape<B>(T, view, 2));
        Lanes<B>::add(rest, M.omega - second - third);
        Lanes<B>::add(rest + kLanes, second);
        Lanes<B>::add(rest + 2 * kLanes, third);
    }
    if (wanted == Potential::with_gradient)
        for (int i = 0; i < 3; ++i)
            Lanes<B>::add(rest + i * kLanes, M.omega * T.n[i] + M.Nx * T.e1[i] + M.Ny * T.e2[i]);
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

inline bool is_sliver(const TriangleGeometry& T, double altitude = kSliverAltitude) {
    return T.double_area < altitude * T.longest_edge * T.longest_edge;
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
void potential(const TriangleGeometry& T, const SourceLanes& sources, Potential wanted, double* out) {
    if (is_sliver(T, kSliverAltitudeOfPotential))
        return add_potential_of_sliver(T, sources, Lanes<B>::kCount, wanted, out);
    add_potential<B>(T, sources, wanted, out);
}

template <class B>
constexpr TriangleKernels make_kernels(const char* name) {
    return {name,
            Lanes<B>::kCount,
            &single_layer<B, true>,
            &single_layer<B, false>,
            &double_layer<B, true>,
            &double_layer<B, false>,
            &potential<B>};
}

}  // namespace
}  // namespace elastolab
