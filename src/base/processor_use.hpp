#pragma once

#include <optional>

namespace elastolab {

/// What the processors of this machine have done since they were started [s of one of them]. Source: proc(5), getrusage.
struct ProcessorUse {
    double all = 0.0, idle = 0.0;
    double own = 0.0;  ///< for this program; without the helpers that it starts
};

/// Until now, in steps of some 10 ms; nothing where the system does not tell.
std::optional<ProcessorUse> processor_use();

/// How many times as long as alone a computation on all processors takes beside what others did between two moments. At
/// most kMostSlowdown.
double slowdown_by_others(const ProcessorUse& before, const ProcessorUse& after);
constexpr double kMostSlowdown = 8.0;

}  // namespace elastolab
