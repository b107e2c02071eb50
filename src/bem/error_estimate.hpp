#pragma once

#include <Eigen/Core>

#include "bem/system.hpp"
#include "bem/traction_space.hpp"
#include "deform/constraint_map.hpp"
#include "deform/node_solver.hpp"

namespace elastolab {

/// How far a solution of linear elements is from fulfilling the boundary equation between its nodes: at every node the
/// mean of H u - G q over the triangles around it, weighted by the node's hat function; 3*n_nodes [L]. At the nodes
/// themselves the equation holds, so one point a triangle, its centroid, tells the mean (with the corners, a rule of
/// the third order). Integrals to four digits, all of them afresh: a few times the assembly.
///
/// The displacements that would cause this residual, with its sign turned (NodeSolver::response_to_residual), are what
/// an averaged (Galerkin) instead of a collocated equation would add: an estimate of the error. The residual alone says
/// little: in a soft thin part a thousandth of it can be a tenth of the displacement.
Eigen::VectorXd residual_between_nodes(const BemSystem& system, const TractionSpace& space,
                                       const NodeSolution& solution, Control& control);

/// Constant elements show a vertex at the mean of the triangles around it: by how much the worst of these differs from
/// the mean; 3*n_vertices [L]. Of the first order in the size of the triangles, as the error of the method is.
/// display: what takes displacements of triangles to those of vertices
Eigen::VectorXd spread_around_vertices(const BemSystem& system, const SparseRows& display,
                                       const NodeSolution& solution);

}  // namespace elastolab
