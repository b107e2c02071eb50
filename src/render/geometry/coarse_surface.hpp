#pragma once

#include <Eigen/Core>

#include "render/geometry/smoothing_groups.hpp"
#include "render/gl/arrays.hpp"

namespace elastolab {

/// Some `n_wanted` triangles that stand for a surface while it moves and drawing all of them takes long: 3 x n drawn
/// vertices of `groups`. Vertices near each other that face the same way are drawn as one of them, if there is one on a
/// crease (vertex clustering: J. Rossignac and P. Borrel, 1993); so a closed surface stays closed, sheets keep both
/// sides, and creases stay sharp. Milliseconds for 100 000 triangles.
Eigen::Matrix3Xi coarse_corners(const PositionsView& rest, const TrianglesView& triangles,
                                const SmoothingGroups& groups, int n_wanted);

}  // namespace elastolab
