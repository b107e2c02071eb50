#pragma once

#include <vector>

#include "render/drawing/legend.hpp"

namespace elastolab {

/// How values become colours: from `low` to `high`, evenly or by their logarithms.
struct ColourScale {
    double low = 0.0, high = 1.0;
    bool logarithmic = false;  ///< then 0 < low

    /// What is evenly coloured: the value, or its logarithm; that of `low` for what is smaller than it.
    double even(double value) const;
    /// From 0 at `low` to 1 at `high`, and nothing beyond; 1/2 everywhere where the two are equal.
    double place(double value) const;
    /// About n round numbers; powers of ten, or 1, 2 and 5 times them, on a logarithmic scale.
    std::vector<LegendTick> ticks(int n) const;
};

/// Bands of one colour each, where a field is shown by them.
inline constexpr int kColourBands = 10;
/// The place on a colour map of a place on the scale, both from 0 to 1: where there are bands, that of the band.
double place_on_map(double place, bool bands);

/// The scale of a field between these: logarithmic ones begin at a thousandth of `high` where `low` is not positive.
/// Even where no logarithms can be.
ColourScale colour_scale(double low, double high, bool logarithmic);

}  // namespace elastolab
