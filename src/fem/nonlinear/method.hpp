#pragma once

#include "deform/method.hpp"

namespace elastolab {

/// Large deformations of a compressible neo-Hookean body.
extern const MethodTraits kNonlinearFemTraits;
inline constexpr MethodKind kNonlinearFem = &kNonlinearFemTraits;

}  // namespace elastolab
