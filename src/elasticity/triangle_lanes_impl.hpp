#pragma once

// What closed forms ask of a vector type B of several doubles, or one double, or one long double.
// Part of triangle_kernels_impl.hpp, which says why all is in an unnamed namespace.

#include <cmath>
#include <concepts>
#include <xsimd/xsimd.hpp>

#include "elasticity/triangle_kernels.hpp"

namespace elastolab {
namespace {

template <class B>
struct Lanes {
    using Number = double;
    static constexpr int kCount = static_cast<int>(B::size);
    static B load(const double* p) { return B::load_unaligned(p); }
    static void add(double* p, const B& value) { (B::load_unaligned(p) + value).store_unaligned(p); }
};

template <std::floating_point Real>
struct Lanes<Real> {
    using Number = Real;
    static constexpr int kCount = 1;
    static Real load(const double* p) { return *p; }
    static void add(double* p, Real value) { *p += static_cast<double>(value); }
};

/// A triangle, in the precision of B.
template <class B>
using Geometry = BasicTriangleGeometry<typename Lanes<B>::Number>;

/// a where the mask holds, else b.
template <class Mask, class B>
B pick(const Mask& mask, const B& a, const B& b) {
    return xsimd::select(mask, a, b);
}
template <std::floating_point B>
B pick(const bool& mask, const B& a, const B& b) {
    return mask ? a : b;
}
template <class B>
B square_root(const B& x) {
    using std::sqrt, xsimd::sqrt;
    return sqrt(x);
}
template <class B>
B logarithm(const B& x) {
    using std::log, xsimd::log;
    return log(x);
}
template <class B>
B arc_tangent(const B& y, const B& x) {
    using std::atan2, xsimd::atan2;
    return atan2(y, x);
}
template <class Mask>
Mask either(const Mask& a, const Mask& b) {
    return a | b;
}

}  // namespace
}  // namespace elastolab
