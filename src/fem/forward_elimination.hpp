#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <span>

#include "base/control.hpp"
#include "fem/sparse_cholesky.hpp"
#include "fem/sparse_matrix.hpp"

namespace elastolab {

/// S -= B^T A^-1 B, lower triangle. With P A P^T = L L^T this is Y^T Y, Y = L^-1 P B. Most of Y is zero where B is
/// sparse: the rows of a supernode of L see only the columns that are not zero in the part of the body that its subtree
/// of the elimination tree covers, and only those are formed. No back substitution, and no column of A^-1.
/// factor  of A, n x n;  B  n x m;  S  m x m
/// Throws Cancelled.
void subtract_compressed_inverse(const SparseCholesky& factor, const SparseMatrix& B, Eigen::MatrixXd& S,
                                 Control& control);

/// What the above takes where the columns of B are those of the unit matrix at these nodes, three for each.
struct CompressedInverseCost {
    double flops = 0.0;
    std::uint64_t bytes = 0;  ///< of Y
};
/// pattern  of the factor; its values are not looked at
CompressedInverseCost compressed_inverse_cost(const SupernodalView& pattern, std::span<const int> nodes);

/// Arithmetic of the factorisation itself [flops].
double factorisation_flops(const SupernodalView& pattern);

}  // namespace elastolab
