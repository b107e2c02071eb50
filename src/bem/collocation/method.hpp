#pragma once

#include "deform/method.hpp"

namespace elastolab {

/// Collocation with constant and with linear boundary elements.
extern const MethodTraits kConstantBemTraits, kLinearBemTraits;
inline constexpr MethodKind kConstantBem = &kConstantBemTraits, kLinearBem = &kLinearBemTraits;

}  // namespace elastolab
