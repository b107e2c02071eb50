#pragma once

#include "deform/method.hpp"

namespace elastolab {

/// The number of tetrahedra is estimated from the volume and the mean edge length of the surface.
Cost predict_linear_fem(const SurfaceMesh& surface, const Method& method);
Cost predict_quadratic_fem(const SurfaceMesh& surface, const Method& method);

}  // namespace elastolab
