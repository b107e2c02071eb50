#pragma once

#include "deform/method.hpp"

namespace elastolab {

/// As predict_linear_fem (fem/cost.hpp).
Cost predict_quadratic_fem(const SurfaceMesh& surface, const Method& method);

}  // namespace elastolab
