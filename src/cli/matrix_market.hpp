#pragma once

#include <Eigen/SparseCore>
#include <ostream>

namespace elastolab {

/// Writes a sparse matrix in the Matrix Market coordinate format, numbers with 17 significant digits; of one that is
/// symmetric to the last bit only the lower triangle, as the format wants it. Failures show in the state of `out`.
void write_matrix_market(std::ostream& out, const Eigen::SparseMatrix<double>& matrix);

}  // namespace elastolab
