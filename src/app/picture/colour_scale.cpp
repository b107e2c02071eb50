#include "app/picture/colour_scale.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.hpp"

namespace elastolab {

namespace {

constexpr double kDecades = 1e-3;  ///< of the largest value, where nothing else says how small is small

}  // namespace

double ColourScale::even(double value) const { return logarithmic ? std::log10(std::max(value, low)) : value; }

double ColourScale::place(double value) const {
    if (!(high > low)) return 0.5;
    return std::clamp((even(value) - even(low)) / (even(high) - even(low)), 0.0, 1.0);
}

std::vector<LegendTick> ColourScale::ticks(int n) const {
    if (!logarithmic || !(high > low) || !std::isfinite(high)) return legend_ticks(low, high, n);
    const double decades = std::log10(high) - std::log10(low);  // their ratio may not be a number
    const std::array<double, 3> factors = {1.0, 2.0, 5.0};
    const std::size_t n_factors = decades * 3.0 <= n + 1.0 ? 3 : 1;
    const int step = std::max(1, static_cast<int>(std::ceil(decades / n)));
    std::vector<LegendTick> ticks;
    for (int power = static_cast<int>(std::floor(std::log10(low))); std::pow(10.0, power) <= high; ++power) {
        if (n_factors == 1 && power % step != 0) continue;
        for (std::size_t f = 0; f < n_factors; ++f) {
            const double value = factors[f] * std::pow(10.0, power);
            if (value >= low * (1.0 - 1e-9) && value <= high * (1.0 + 1e-9))
                ticks.push_back({value, formatted("%.4g", value)});
        }
    }
    return ticks;
}

double place_on_map(double place, bool bands) {
    return bands ? (std::clamp(std::floor(place * kColourBands), 0.0, kColourBands - 1.0) + 0.5) / kColourBands : place;
}

ColourScale colour_scale(double low, double high, bool logarithmic) {
    const double lowest = low > 0.0 ? low : kDecades * high;
    if (!logarithmic || !(lowest > 0.0) || !std::isfinite(high)) return {low, high, false};
    return {lowest, high, true};
}

}  // namespace elastolab
