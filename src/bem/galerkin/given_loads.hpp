#pragma once

#include <Eigen/Core>
#include <span>

#include "base/control.hpp"
#include "bem/galerkin/boundary_entries.hpp"
#include "bem/galerkin/layers_of_tractions.hpp"
#include "bem/galerkin/tractions.hpp"
#include "deform/unit_load.hpp"
#include "elasticity/material.hpp"

namespace elastolab {

/// What the tractions g of given loads add to the equations, a column for each load: (B - K)^T g at every vertex, and
/// below it V g on every triangle, (3*n_vertices + 3*n_triangles) x loads.size(), node-major. The resultant of the
/// former is exact. In K^T g and V g the tractions of a body force are those at the triangles' centroids. The result
/// does not depend on the number of threads. Throws Cancelled.
Eigen::MatrixXd given_layers(const BoundaryPairs& pairs, const Material& material, std::span<const UnitLoad> loads,
                             const LayerOptions& options, Control& control);
/// V g on the tractions of a constrained set, from these columns: tractions.size() x n_loads.
Eigen::MatrixXd given_single_layer(const Eigen::MatrixXd& layers, const Boundary& boundary,
                                   const ClosedSurfaces& surfaces, const GalerkinTractions& tractions);

}  // namespace elastolab
