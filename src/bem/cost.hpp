#pragma once

#include "deform/method.hpp"

namespace elastolab {

Cost predict_constant_bem(const SurfaceMesh& surface, const Method& method);
Cost predict_linear_bem(const SurfaceMesh& surface, const Method& method);
Cost predict_galerkin_bem(const SurfaceMesh& surface, const Method& method);

}  // namespace elastolab
