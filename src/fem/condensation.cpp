#include "fem/condensation.hpp"

#include <cassert>

#include "fem/forward_elimination.hpp"
#include "fem/sparse_cholesky.hpp"

namespace elastolab {

namespace {

/// Rows [row, row + rows) and columns [column, column + columns) of a sparse matrix.
SparseMatrix submatrix(const SparseMatrix& K, int row, int rows, int column, int columns) {
    SparseMatrix sub = SparseMatrix(K.middleCols(column, columns)).middleRows(row, rows);
    sub.makeCompressed();
    return sub;
}

}  // namespace

Eigen::MatrixXd condense_to_surface(const SparseMatrix& K, int n_surface, Control& control) {
    const int n_s = 3 * n_surface, n_i = static_cast<int>(K.rows()) - n_s;
    assert(n_i >= 0);
    Eigen::MatrixXd S = submatrix(K, 0, n_s, 0, n_s);
    if (n_i == 0) return S;
    const SparseMatrix K_ii = submatrix(K, n_s, n_i, n_s, n_i);
    const CholeskyAnalysis analysis(K_ii);
    const SparseCholesky factor(analysis, K_ii, "stiffness matrix of the interior", &control);
    control.checkpoint();
    subtract_compressed_inverse(factor, submatrix(K, n_s, n_i, 0, n_s), S, control);
    S.triangularView<Eigen::StrictlyUpper>() = S.transpose();
    return S;
}

}  // namespace elastolab
