#pragma once

#include "deform/method.hpp"

namespace elastolab {

/// Symmetric Galerkin boundary elements.
extern const MethodTraits kGalerkinBemTraits;
inline constexpr MethodKind kGalerkinBem = &kGalerkinBemTraits;

}  // namespace elastolab
