#pragma once

#include <Eigen/Core>
#include <functional>

namespace elastolab {

/// The 1-norm of the inverse of a symmetric n x n matrix A, estimated by a few solves (a lower bound, seldom by more
/// than a factor of three). solve: A^-1 x. n > 0. Source: N. J. Higham, ACM Trans. Math. Softw. 14 (1988), LAPACK's
/// dlacn2.
double estimate_inverse_norm(int n, const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& solve);

}  // namespace elastolab
