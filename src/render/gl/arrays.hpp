#pragma once

#include <Eigen/Core>

namespace elastolab {

/// Read access to positions, one column each: 3 x n [L]; a Matrix3Xd, or a Map of a vector of 3n numbers.
using PositionsView = Eigen::Ref<const Eigen::Matrix3Xd>;
/// Read access to triangles, one column each: 3 x n vertex numbers, counter-clockwise seen from outside.
using TrianglesView = Eigen::Ref<const Eigen::Matrix3Xi>;
/// Line segments, one column each: 2 x n vertex numbers.
using Edges = Eigen::Matrix2Xi;

/// Every edge of these triangles once, the smaller vertex number first, in ascending order.
Edges edges_of(const TrianglesView& triangles);

}  // namespace elastolab
