#pragma once

#include "deform/method.hpp"

namespace elastolab {

/// Linear tetrahedra.
extern const MethodTraits kLinearFemTraits;
inline constexpr MethodKind kFem = &kLinearFemTraits;

}  // namespace elastolab
