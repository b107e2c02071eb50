#pragma once

#include <Eigen/Core>

#include "deform/bem_system.hpp"
#include "deform/load_plan.hpp"
#include "deform/node_solver.hpp"

namespace elastolab {

/// How far a solution of linear elements is from fulfilling the boundary equation between its nodes: at every node the
/// mean of H u - G q over the triangles around it, weighted by the node's hat function; 3*n_nodes [L]. At the nodes
/// themselves the equation holds, so one point a triangle, its centroid, tells the mean (with the corners, a rule of
/// the third order). Integrals to six digits, all of them afresh: about twice the assembly.
///
/// The displacements that would cause this residual, with its sign turned (NodeSolver::response_to_residual), are what
/// an averaged (Galerkin) instead of a collocated equation would add: an estimate of the error. The residual alone says
/// little: in a soft thin part a thousandth of it can be a tenth of the displacement.
Eigen::VectorXd residual_between_nodes(const BemSystem& system, const LoadPlan& plan, const NodeSolution& solution,
                                       Control& control);

}  // namespace elastolab
