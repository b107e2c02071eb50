#pragma once

#include <Eigen/Core>
#include <vector>

namespace elastolab {

/// Orthonormal combinations of `modes` (orthonormal, three rows an item) that vanish at these items: what a
/// constrained set leaves free. Mostly none.
Eigen::MatrixXd unseen_modes(const Eigen::MatrixXd& modes, const std::vector<int>& items);

/// Makes X orthogonal to the columns of N, which are orthonormal.
void orthogonalise(Eigen::MatrixXd& X, const Eigen::MatrixXd& N);

}  // namespace elastolab
