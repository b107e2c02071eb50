#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/control.hpp"

namespace elastolab {

/// Number of rows up to which the BLAS is called on one thread for a part of the matrix each (for_strips): quicker
/// beside other processes, and as quick alone. The products of larger ones are worth the BLAS's own threads.
constexpr int kLuInStrips = 4096;

/// A <- its factors L and U with row exchanges, as LAPACK's getrf leaves them, by block columns: each by getrf, then
/// the columns to its right are updated by triangular solves and a matrix product. Between the blocks `control`, when
/// given, is told the progress of the present stage and may cancel. Returns what getrf does: 0, or the number of the
/// first pivot that vanishes. Throws Cancelled.
int factorise_lu(Eigen::MatrixXd& A, std::vector<int>& pivots, Control* control, int in_strips = kLuInStrips);
int factorise_lu(Eigen::MatrixXf& A, std::vector<int>& pivots, Control* control, int in_strips = kLuInStrips);

}  // namespace elastolab
