#pragma once

#include <Eigen/Core>
#include <vector>

#include "render/gl/arrays.hpp"

namespace elastolab {

/// How a surface is split where it has creases. Around a vertex, triangles that meet smoothly share one drawn vertex
/// and so one normal; across a crease there are several.
struct SmoothingGroups {
    Eigen::Matrix3Xi corners;   ///< 3 x n_triangles: the drawn vertex of each corner
    std::vector<int> vertices;  ///< of each drawn vertex, the vertex it stands for
    Edges features;             ///< creases and open borders that make lines of some length, as drawn vertices
};

/// A crease is an edge whose triangles turn by more than `crease_angle` [radians] at rest, or an edge of other than two
/// triangles of equal orientation.
SmoothingGroups smoothing_groups(const PositionsView& rest, const TrianglesView& triangles, double crease_angle = 1.0);

}  // namespace elastolab
