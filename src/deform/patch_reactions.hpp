#pragma once

#include <span>
#include <vector>

#include "deform/deformer.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Positions in the list fixed + handles, grouped into patches: vertices that edges of the surface connect within the
/// fixed set or within the handles. A patch holds or moves the body as one piece, so its total force means something;
/// that of a single vertex depends on the mesh.
using ConstrainedPatches = std::vector<std::vector<int>>;
ConstrainedPatches constrained_patches(const SurfaceMesh& surface, std::span<const int> fixed,
                                       std::span<const int> handles);

/// Largest total force of a patch, or total moment over the radius of the body [force]. Moments are about the mean of
/// the body's vertices, the radius is the distance of the farthest.
double largest_patch_reaction(const SurfaceMesh& surface, const ConstrainedPatches& patches,
                              const Reactions& reactions);

}  // namespace elastolab
