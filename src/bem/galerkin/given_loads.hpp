#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>

#include "base/control.hpp"
#include "bem/galerkin/boundary_entries.hpp"
#include "bem/galerkin/tractions.hpp"
#include "deform/unit_load.hpp"
#include "elasticity/material.hpp"

namespace elastolab {

/// (B - K)^T g, what the loads' tractions add to the nodes' equations: 3*n_vertices x loads.size(),
/// node-major. Their resultant is exact. In K^T g the tractions of a body force are those at the triangles' centroids.
/// Throws Cancelled.
Eigen::MatrixXd given_nodal_forces(const std::shared_ptr<const BoundaryPairs>& pairs, const Material& material,
                                   std::span<const UnitLoad> loads, Control& control);
/// V g on the tractions of a constrained set: tractions.size() x loads.size(). Throws Cancelled.
Eigen::MatrixXd given_single_layer(const std::shared_ptr<const BoundaryPairs>& pairs, const ClosedSurfaces& surfaces,
                                   const GalerkinTractions& tractions, const Material& material,
                                   std::span<const UnitLoad> loads, Control& control);

}  // namespace elastolab
