#pragma once

#include <string>
#include <vector>

namespace elastolab {

struct LegendTick {
    double value = 0.0;
    std::string text;  ///< "0.25", "-1500", "2.5e-07": no more digits than tell the ticks apart
};

/// Round numbers (1, 2 or 5 times a power of ten apart) within [low, high], about `n` of them, at most n + 1,
/// ascending. One tick when low = high; none when they are not finite or in the wrong order.
std::vector<LegendTick> legend_ticks(double low, double high, int n);

/// The smallest of 1, 2, 5 times a power of ten that is at least `value`; value > 0.
double round_step(double value);

}  // namespace elastolab
