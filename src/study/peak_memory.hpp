#pragma once

#include <cstdint>

namespace elastolab {

/// The most memory that this process has taken since construction, beyond what it held then. Free memory is given back
/// to the system first and the system's peak is reset, so that what was used before does not count. Helper processes
/// (TetGen) are not included.
class PeakMemory {
public:
    PeakMemory();
    /// Not a number where the system does not tell.
    double bytes() const;

private:
    double before_;
};

}  // namespace elastolab
