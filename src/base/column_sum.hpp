#pragma once

#include <Eigen/Core>

namespace elastolab {

/// y <- rest + A x for few columns, in one pass over them: sequential, without the cost of a call of the BLAS, which is
/// more than the work where A is small. `rest` and `y` are not the same.
void column_sum(const Eigen::VectorXd& rest, const Eigen::MatrixXd& A, const Eigen::VectorXd& x, Eigen::VectorXd& y);

}  // namespace elastolab
