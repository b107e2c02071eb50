#pragma once

#include <Eigen/Core>

namespace elastolab {

/// Products with a matrix A in single precision, all sums in double precision, for few columns X. They take the time of
/// reading A once; a copy of A in double precision would have to be written and read as well. Sequential.

/// Y += A X
void add_mixed_product(const Eigen::Ref<const Eigen::MatrixXf>& A, const Eigen::Ref<const Eigen::MatrixXd>& X,
                       Eigen::Ref<Eigen::MatrixXd> Y);
/// A^T X
Eigen::MatrixXd transposed_mixed_product(const Eigen::Ref<const Eigen::MatrixXf>& A,
                                         const Eigen::Ref<const Eigen::MatrixXd>& X);

}  // namespace elastolab
