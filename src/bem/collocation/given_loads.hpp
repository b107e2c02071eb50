#pragma once

#include <Eigen/Core>
#include <span>

#include "base/control.hpp"
#include "bem/boundary.hpp"
#include "deform/unit_load.hpp"
#include "elasticity/material.hpp"

namespace elastolab {

/// The single layer of the loads' tractions, seen from collocation points: 3*points.size() x loads.size().
/// Integrates in strips. Throws Cancelled.
Eigen::MatrixXd given_single_layer(const Boundary& boundary, const CollocationPoints& points, const Material& material,
                                   double tolerance, std::span<const UnitLoad> loads, Control& control);

}  // namespace elastolab
