#pragma once

#include <cstdint>

namespace elastolab {

/// Flops a second of a matrix product on this machine, measured once; what predictions of time are made from.
double product_speed();

/// Bytes of a square matrix of n rows.
inline std::uint64_t square_bytes(double n) { return static_cast<std::uint64_t>(8.0 * n * n); }

}  // namespace elastolab
