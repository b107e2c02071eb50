#pragma once

#include <Eigen/SparseCore>

namespace elastolab {

/// Square sparse matrices over 3 x nodes degrees of freedom, node-major. Symmetric ones store both triangles.
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

}  // namespace elastolab
