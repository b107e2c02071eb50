#pragma once

#include <span>
#include <vector>

#include "bem/boundary.hpp"

namespace elastolab {

/// The columns along a space-filling (Morton) curve: neighbours in the list are neighbours in space, however the mesh
/// is numbered, and what is integrated for them together is chosen for places that lie together.
std::vector<int> along_a_curve(const Positions& points);

/// Triangles along the curve through their centroids.
std::vector<int> triangles_along_a_curve(const Boundary& boundary, std::span<const int> triangles);
std::vector<int> triangles_along_a_curve(const Boundary& boundary);

}  // namespace elastolab
