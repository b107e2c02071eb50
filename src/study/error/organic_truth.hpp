#pragma once

#include <span>
#include <vector>

#include "deform/deformer.hpp"
#include "elasticity/material.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Displacements and reactions of the vertices of a surface, converged, and how far they may still be off.
struct OrganicTruth {
    Positions displacements;      ///< 3 x n_vertices, extrapolated
    Reactions reactions;          ///< at the constrained vertices, extrapolated
    double relative_error = 0.0;  ///< estimated, rms over the free vertices / rms of their displacements
    /// Estimated, of the reactions of the worst patch, over the largest (deform/patch_reactions.hpp).
    double relative_force_error = 0.0;
    int n_nodes = 0;  ///< of the finest quadratic mesh
};

/// How fine the truth is computed: rounds of splitting the surface triangles that touch the rim of the constrained
/// region, at least 1. Each halves the error and nearly doubles the time. The rabbit of 600 vertices: 65 000 nodes and
/// an estimate of 9e-3 after one round, 120 000 and 2e-3 after two; its linear tetrahedra are 1e-1 off.
struct TruthOptions {
    int rim_refinements = 1;
};

/// Loads beside the prescribed displacements: unit loads on the coarse surface, and their factors.
struct GivenLoads {
    std::vector<UnitLoad> loads = {};
    Eigen::VectorXd factors = {};
};

/// The displacement problem on the same polyhedron with the same constrained region (all triangles whose three
/// vertices are constrained, displaced linearly between them; the rest free), by quadratic tetrahedra.
///
/// Along the rim the solution behaves like the square root of the distance, so that the error falls like the first
/// power of the element size there, whatever the degree. The mesh is therefore graded towards the rim; then solved on
/// its tetrahedra and on all of them split in eight, and extrapolated at this order. The estimated error is how
/// much the last round of grading changed the result, two to four times the error that is left.
///
/// constrained  vertices, each a corner of a constrained triangle (asserted): a single point has no converged answer
/// values       3 x constrained.size()
OrganicTruth compute_truth(const SurfaceMesh& surface, std::span<const int> constrained, const Positions& values,
                           const Material& material, const TruthOptions& options = {}, const GivenLoads& given = {});

}  // namespace elastolab
