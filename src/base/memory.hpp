#pragma once

#include <cstdint>

namespace elastolab {

/// Largest resident set of this process so far [bytes].
std::uint64_t peak_memory_bytes();

/// The resident set of this process now [bytes]; 0 where the system does not tell.
std::uint64_t resident_memory_bytes();

/// Memory that can still be taken without swapping [bytes], as the system estimates it (and as a control
/// group and the limits of the address space and of data in it allow).
std::uint64_t available_memory_bytes();

/// Gives the system back what this process has freed and the allocator has kept. Milliseconds; for after work that took
/// much memory once.
void return_freed_memory();

}  // namespace elastolab
