#pragma once

#include <memory>
#include <span>
#include <vector>

#include "bem/boundary_field.hpp"
#include "bem/galerkin/tractions.hpp"
#include "deform/node_solver.hpp"
#include "deform/unit_load.hpp"

namespace elastolab {

/// The inside for solutions with loads: nodal forces at the constrained vertices, then the tractions. The force at a
/// vertex without a constrained triangle is spread by its hat function; that at all others is what the tractions add
/// up to. The given loads come on top.
std::shared_ptr<const InteriorField> galerkin_field(const std::shared_ptr<const Boundary>& boundary,
                                                    double poisson_ratio, const std::vector<int>& vertices,
                                                    const GalerkinTractions& tractions, std::span<const UnitLoad> loads,
                                                    NodeSolution&& solution);

}  // namespace elastolab
