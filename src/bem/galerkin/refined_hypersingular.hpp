#pragma once

#include <Eigen/Core>
#include <memory>

#include "base/control.hpp"
#include "bem/galerkin/boundary_entries.hpp"
#include "elasticity/material.hpp"
#include "mesh/refine.hpp"

namespace elastolab {

/// The hypersingular operator of a refined surface, as integrated, from that of the coarse one: only the columns of new
/// vertices are integrated. A coarse hat is the sum of fine ones, so that with P the weights of coarse vertices at new
/// ones   D_coarse = D_oo + P^T D_no + D_on P + P^T D_nn P   gives D_oo, the part between old vertices.
/// coarse, result: 3V square of their surface, for the same material [force / L], symmetric. pairs: of the refined
/// surface. Throws Cancelled. Source: docs/formulation.md section 7.
Eigen::MatrixXd refined_hypersingular(const Eigen::MatrixXd& coarse, const RefinedSurface& fine,
                                      const std::shared_ptr<const BoundaryPairs>& pairs, const Material& material,
                                      Control& control);

}  // namespace elastolab
