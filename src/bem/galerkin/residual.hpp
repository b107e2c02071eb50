#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "base/control.hpp"
#include "bem/galerkin/boundary_entries.hpp"
#include "bem/galerkin/surfaces.hpp"
#include "bem/galerkin/tractions.hpp"
#include "bem/hierarchical/cluster_tree.hpp"
#include "deform/node_solver.hpp"
#include "elasticity/material.hpp"

namespace elastolab {

/// The Galerkin equations of one solid, row by row: entries are integrated when they are asked for, none is kept.
struct GalerkinEquations {
    std::shared_ptr<const BoundaryPairs> pairs;
    std::shared_ptr<const ClusterTree> tree;  ///< of the vertices
    const ClosedSurfaces& surfaces;
    Material material;
};

/// What given loads add to the right sides, for the load factors of the solution; empty without loads.
struct GivenTerms {
    Eigen::VectorXd nodal_forces;  ///< 3V, in the order of the vertices
    Eigen::VectorXd single_layer;  ///< V g at the tractions of the set
};

/// The larger of | D u + K^T t - R - given | and | K u - V t - given |, each over the same of absolute values,
/// Euclidean, over evenly spread equations: at most 128 vertices and 64 triangles, fewer where slivers or thin walls
/// make them expensive, with integrals computed afresh, but for those of given loads.
/// Rigid motions are taken out of u first, as D and K annihilate them but for the tolerance of their integrals.
/// vertices: constrained; solution: one column, loads as those of GalerkinDirectSolver. Throws Cancelled.
double galerkin_residual(const GalerkinEquations& equations, const std::vector<int>& vertices,
                         const GalerkinTractions& tractions, const GivenTerms& given, const NodeSolution& solution,
                         Control& control);

/// Bytes that it takes at its peak, on all threads. n_loaded: triangles that carry tractions.
std::uint64_t galerkin_residual_memory(const SurfaceMesh& mesh, std::int64_t n_loaded);

}  // namespace elastolab
