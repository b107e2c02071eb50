#pragma once

#include <Eigen/Core>

#include "base/control.hpp"
#include "fem/sparse_matrix.hpp"

namespace elastolab {

/// Stiffness condensed to the first n_surface nodes, interior nodes free of load:
///   S = K_ss - K_si K_ii^-1 K_is,     3*n_surface square, dense, exactly symmetric [force / L]
/// K  3n x 3n, both triangles, of one connected solid, surface nodes first.
/// With P K_ii P^T = L L^T this is K_ss - Y^T Y, Y = L^-1 P K_is. Most of Y is zero: the rows of a supernode of L see
/// only the surface around the part of the body that its subtree of the elimination tree covers, and only those columns
/// are formed. Throws SolveError (not positive definite, out of memory), Cancelled.
Eigen::MatrixXd condense_to_surface(const SparseMatrix& K, int n_surface, Control& control);

}  // namespace elastolab
