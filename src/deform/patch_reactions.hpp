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

/// Whether statics alone tells what these vertices bear, as of a body that one patch holds: reactions that balance the
/// loads are exact then, whatever the mesh. Handles under a force are none of them.
bool is_statically_determinate(const SurfaceMesh& surface, std::span<const int> fixed, std::span<const int> moved);

/// From corner to corner of the surface's box [L].
double size_of(const SurfaceMesh& surface);

/// The largest reaction of a patch in `error` over the largest in `reactions`, or over a tenth of all forces, which add
/// up to nothing under loads that balance each other. Of a body whose largest displacement is `motion` [L] and off by
/// the relative `motion_error`. load_forces: sizes of the loads' forces, added up (gross_force).
double relative_reaction_error(const Body& body, const ConstrainedSet& set, const Reactions& reactions,
                               const Reactions& error, double load_forces, double motion, double motion_error);

}  // namespace elastolab
