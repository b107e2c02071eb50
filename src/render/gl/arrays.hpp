#pragma once

#include <Eigen/Core>

namespace elastolab {

/// Read access to positions, one column each: 3 x n [L]; a Matrix3Xd, or a Map of a vector of 3n numbers.
using PositionsView = Eigen::Ref<const Eigen::Matrix3Xd>;
/// Read access to triangles, one column each: 3 x n vertex numbers, counter-clockwise seen from outside.
using TrianglesView = Eigen::Ref<const Eigen::Matrix3Xi>;
/// Line segments, one column each: 2 x n vertex numbers.
using Edges = Eigen::Matrix2Xi;

/// The edges at which these triangles do not close a surface, each once, the smaller vertex number first, in ascending
/// order: all that are not shared by just two triangles, which run through them in opposite directions.
Edges unpaired_edges(const TrianglesView& triangles);

}  // namespace elastolab
