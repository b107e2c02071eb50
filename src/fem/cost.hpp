#pragma once

#include "deform/method.hpp"

namespace elastolab {

/// Nodes are estimated from the surface (mesh/tets/node_estimate.hpp), the factor from their number and the shape.
Cost predict_linear_fem(const SurfaceMesh& surface, const Method& method);
Cost predict_quadratic_fem(const SurfaceMesh& surface, const Method& method);
/// One set, and an answer to a motion of medium size.
Cost predict_nonlinear_fem(const SurfaceMesh& surface, const Method& method);

}  // namespace elastolab
