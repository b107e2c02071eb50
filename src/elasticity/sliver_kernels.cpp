#include "elasticity/sliver_kernels.hpp"

#include "elasticity/triangle_geometry.hpp"
#include "elasticity/triangle_kernels_impl.hpp"

namespace elastolab {
namespace {

/// A pack of one lane.
SourceLanes one_of(const SourceLanes& sources, int lane) {
    SourceLanes source{};
    source.x[0] = sources.x[lane], source.y[0] = sources.y[lane], source.z[0] = sources.z[lane];
    source.own_triangle[0] = sources.own_triangle[lane];
    return source;
}

/// One source after the other.
template <class Moments, int kNumbers>
void add_closed_form(const TriangleGeometry& triangle, const SourceLanes& sources, int lanes, bool linear,
                     double* const* out) {
    const BasicTriangleGeometry<long double> T = extended_geometry(triangle);
    for (int lane = 0; lane < lanes; ++lane) {
        const SourceLanes source = one_of(sources, lane);
        double values[3][kNumbers] = {};
        double* const target[3] = {values[0], values[1], values[2]};
        if (linear)
            closed_form<long double, Moments, true>(T, source, target);
        else
            closed_form<long double, Moments, false>(T, source, target);
        for (int shape = 0; shape < (linear ? 3 : 1); ++shape)
            for (int k = 0; k < kNumbers; ++k) out[shape][k * lanes + lane] += values[shape][k];
    }
}

}  // namespace

void add_single_layer_of_sliver(const TriangleGeometry& triangle, const SourceLanes& sources, int lanes, bool linear,
                                double* const* out) {
    add_closed_form<SingleMoments<long double>, kSingleLayerNumbers>(triangle, sources, lanes, linear, out);
}

void add_double_layer_of_sliver(const TriangleGeometry& triangle, const SourceLanes& sources, int lanes, bool linear,
                                double* const* out) {
    add_closed_form<DoubleMoments<long double>, kDoubleLayerNumbers>(triangle, sources, lanes, linear, out);
}

void add_potential_of_sliver(const TriangleGeometry& triangle, const SourceLanes& sources, int lanes, Potential wanted,
                             double* out) {
    const BasicTriangleGeometry<long double> T = extended_geometry(triangle);
    const int n_numbers = wanted == Potential::tensor ? kPotentialTensorNumbers : kPotentialNumbers;
    for (int lane = 0; lane < lanes; ++lane) {
        double values[kPotentialNumbers] = {};
        add_potential<long double>(T, one_of(sources, lane), wanted, values);
        for (int k = 0; k < n_numbers; ++k) out[k * lanes + lane] += values[k];
    }
}

}  // namespace elastolab
