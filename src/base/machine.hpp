#pragma once

#include <cstdint>
#include <string>

namespace elastolab {

/// The machine that a measurement was made on.
struct Machine {
    std::string cpu;                 ///< model name, "unknown" when the system does not tell
    int cores = 1;                   ///< that this process may use
    std::uint64_t memory_bytes = 0;  ///< installed
};

Machine this_machine();

}  // namespace elastolab
