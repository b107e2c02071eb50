#pragma once

#include <array>
#include <span>

#include "fem/sparse_matrix.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Three nodes that hold a body with six reactions: the first in all directions, the second across the line to the
/// first, the third across the plane of the three. Statically determinate, so that loads in equilibrium cause no
/// reaction, and with K_g = K + (springs at the support) K_g^-1 f solves K u = f exactly.
using StaticSupport = std::array<int, 3>;

/// Three well-separated ones among the first n_candidates nodes, which are not all on one line.
StaticSupport choose_support(const Positions& positions, int n_candidates);

/// K plus a spring in each of the six directions of the support, as stiff as its nodes are: positive definite for one
/// connected body, with the pattern of K.
SparseMatrix grounded(const SparseMatrix& K, const Positions& positions, const StaticSupport& support);

/// K with the rows and columns of the nodes set to zero but for their diagonal; same pattern, explicit zeros. Solving
/// with a load b gives K_ff^-1 b_f on the other nodes, and b_i / K_ii on these.
SparseMatrix eliminated(const SparseMatrix& K, std::span<const int> nodes);

}  // namespace elastolab
