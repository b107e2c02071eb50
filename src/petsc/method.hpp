#pragma once

#include "deform/method.hpp"

namespace elastolab {

/// The same method with its stiffness on the processes of the Session: another row of the table, with the same name.
/// Null for a method other than linear and quadratic FEM.
MethodKind distributed(MethodKind kind);

}  // namespace elastolab
