#pragma once

#include <cstdint>
#include <string>

namespace elastolab {

/// Cores that this process may use, at least 1: those that its affinity allows (taskset), and no more than the
/// processor time of its control group (a container's quota), rounded up. More threads would only wait for each other.
int available_cores();

/// The machine that a measurement was made on.
struct Machine {
    std::string cpu;                 ///< model name, "unknown" when the system does not tell
    int cores = 1;                   ///< that this process may use
    std::uint64_t memory_bytes = 0;  ///< installed
};

Machine this_machine();

}  // namespace elastolab
