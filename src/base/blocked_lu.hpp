#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/control.hpp"

namespace elastolab {

/// Number of rows up to which LAPACK factorises a matrix in one call, which delays a cancel by some tenths of a second.
constexpr int kLuAtOnce = 3072;

/// A <- its factors L and U with row exchanges, as LAPACK's getrf leaves them. Matrices larger than `at_once` are
/// factorised by block columns: each by getrf, then the columns to its right are updated by triangular solves and
/// one matrix product. Between the blocks `control`, when given, is told the progress of the present stage and may
/// cancel; that costs 0 to 10 % of the time. Returns what getrf does: 0, or the number of the first pivot that
/// vanishes. Throws Cancelled.
int factorise_lu(Eigen::MatrixXd& A, std::vector<int>& pivots, Control* control, int at_once = kLuAtOnce);
int factorise_lu(Eigen::MatrixXf& A, std::vector<int>& pivots, Control* control, int at_once = kLuAtOnce);

}  // namespace elastolab
