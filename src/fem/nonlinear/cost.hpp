#pragma once

#include "deform/method.hpp"

namespace elastolab {

/// One set, and an answer to a motion of medium size.
Cost predict_nonlinear_fem(const SurfaceMesh& surface, const Method& method);

}  // namespace elastolab
