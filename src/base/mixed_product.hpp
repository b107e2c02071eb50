#pragma once

#include <Eigen/Core>

namespace elastolab {

/// Products of a matrix in single precision with all sums in double precision, for few columns X: they take the time
/// of reading A once, where a copy in double precision would take that of writing and reading it too. Sequential.

/// Y += A X
void add_mixed_product(const Eigen::Ref<const Eigen::MatrixXf>& A, const Eigen::Ref<const Eigen::MatrixXd>& X,
                       Eigen::Ref<Eigen::MatrixXd> Y);
/// A^T X
Eigen::MatrixXd transposed_mixed_product(const Eigen::Ref<const Eigen::MatrixXf>& A,
                                         const Eigen::Ref<const Eigen::MatrixXd>& X);

}  // namespace elastolab
