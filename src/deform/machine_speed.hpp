#pragma once

#include <cstdint>

namespace elastolab {

// What predictions of time are made from, each measured once, which takes some milliseconds. They differ from
// machine to machine by different factors.

/// Flops a second of matrix products, on all threads.
double product_speed();
/// Points a second at which the potential of a triangle is evaluated in closed form, on all threads: the speed of
/// boundary integrals.
double integral_speed();
/// The same on one thread without vector instructions: the speed of what is neither, such as filling a surface with
/// tetrahedra.
double scalar_speed();

/// Work that is predicted, by what decides how long it takes.
struct Work {
    double flops = 0.0;      ///< of matrix products: product_speed()
    double integrals = 0.0;  ///< in evaluations of the potential of a triangle: integral_speed()
    double scalars = 0.0;    ///< the same of what no vector instructions do: scalar_speed()
    double waiting = 0.0;    ///< the same time on any machine [s]

    /// On this machine. Its speeds are measured when they are first asked for: whoever wants to know no time pays
    /// nothing for them.
    double seconds() const;
    /// On a machine of usual speeds, whatever this one is and whatever else it does: for choices that must not depend
    /// on that.
    double usual_seconds() const;

    Work& operator+=(const Work& other);
    Work& operator*=(double times);
};

/// Bytes of a square matrix of n rows.
inline std::uint64_t square_bytes(double n) { return static_cast<std::uint64_t>(8.0 * n * n); }

}  // namespace elastolab
