#pragma once

#include <vector>

#include "mesh/tets/size_field.hpp"

namespace elastolab {

/// Points for TetGen to begin with: the centres of an octree's cells in the box of these vertices, well away from the
/// surface, about twice as far from each other as edges are wanted there. Without them the first tetrahedra join far
/// sides of a round body, thousands at one vertex, and each further point inside costs as many (a ball of 35 330
/// vertices: 247 s, with them 3 s). Some may be outside; TetGen drops those. None where they would be more than the
/// vertices.
/// vertices    x y z of each
/// For the helper program that runs TetGen.
std::vector<double> seed_points(const std::vector<double>& vertices, const SizeField& sizes);

}  // namespace elastolab
