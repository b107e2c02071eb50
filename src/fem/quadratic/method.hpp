#pragma once

#include "deform/method.hpp"

namespace elastolab {

/// Ten-node tetrahedra on the tetrahedra of linear FEM. On demand only: dense matrices would be of all surface nodes,
/// four times as many as its vertices.
extern const MethodTraits kQuadraticFemTraits;
inline constexpr MethodKind kQuadraticFem = &kQuadraticFemTraits;

}  // namespace elastolab
