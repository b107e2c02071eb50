#pragma once

#include <memory>
#include <vector>

#include "bem/boundary_field.hpp"
#include "bem/galerkin/tractions.hpp"
#include "deform/node_solver.hpp"

namespace elastolab {

/// The inside for solutions with loads: nodal forces at the constrained vertices, then the tractions. The force at a
/// vertex without a constrained triangle is spread by its hat function; that at all others is what the tractions add
/// up to.
std::shared_ptr<const BoundaryField> galerkin_field(const std::shared_ptr<const Boundary>& boundary,
                                                    double poisson_ratio, const std::vector<int>& vertices,
                                                    const GalerkinTractions& tractions, NodeSolution&& solution);

}  // namespace elastolab
