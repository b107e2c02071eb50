#include "render/drawing/legend.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"

namespace elastolab {

namespace {

constexpr double kLargestPlain = 1e5, kSmallestPlain = 1e-3;  // beyond these, numbers get an exponent

int exponent_of(double value) { return static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-9)); }

/// `value` with the digits that its neighbours at distance `step` need; `largest` decides whether all get exponents,
/// then all the same one.
std::string tick_text(double value, double step, double largest) {
    if (value == 0.0) return "0";
    if (largest < kLargestPlain && largest >= kSmallestPlain)
        return formatted("%.*f", std::clamp(-exponent_of(step), 0, 12), value);
    const int exponent = exponent_of(largest);
    return formatted("%.*fe%+03d", std::clamp(exponent - exponent_of(step), 0, 12), value / std::pow(10.0, exponent),
                     exponent);
}

}  // namespace

double round_step(double value) {
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= value * (1.0 - 1e-12)) return factor * power;
    return 10.0 * power;
}

std::vector<LegendTick> legend_ticks(double low, double high, int n) {
    if (!std::isfinite(low) || !std::isfinite(high) || low > high || n < 1) return {};
    const double largest = std::max(std::abs(low), std::abs(high));
    if (high - low <= 1e-12 * largest) return {{low, formatted("%.*g", 4, low)}};
    const double step = round_step((high - low) / n);
    std::vector<LegendTick> ticks;
    const double slack = 1e-9 * step;
    for (double i = std::ceil((low - slack) / step); i * step <= high + slack; i += 1.0) {
        const double value = i == 0.0 ? 0.0 : i * step;
        ticks.push_back({value, tick_text(value, step, largest)});
    }
    return ticks;
}

}  // namespace elastolab
