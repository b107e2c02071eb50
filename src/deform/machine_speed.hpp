#pragma once

#include <cstdint>

namespace elastolab {

// What predictions of time are made from, each measured once. They differ from machine to machine by different factors.

/// Flops a second of a matrix product.
double product_speed();
/// Points a second at which the potential of a triangle is evaluated in closed form, on all threads: the speed of
/// boundary integrals.
double integral_speed();
/// The same on one thread without vector instructions: the speed of what is neither, such as filling a surface with
/// tetrahedra.
double scalar_speed();

/// Bytes of a square matrix of n rows.
inline std::uint64_t square_bytes(double n) { return static_cast<std::uint64_t>(8.0 * n * n); }

}  // namespace elastolab
