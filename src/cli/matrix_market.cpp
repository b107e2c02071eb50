#include "cli/matrix_market.hpp"

#include "base/text.hpp"

namespace elastolab {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// To the last bit: sums in different orders at (i, j) and (j, i) may differ by rounding, which is not symmetric here.
bool is_symmetric(const Sparse& matrix) {
    if (matrix.rows() != matrix.cols()) return false;
    const Sparse difference = matrix - Sparse(matrix.transpose());
    return difference.nonZeros() == 0 || difference.coeffs().abs().maxCoeff() == 0.0;
}

template <class Visit>
void visit_entries(const Sparse& matrix, bool lower_only, const Visit& visit) {
    for (int column = 0; column < matrix.outerSize(); ++column)
        for (Sparse::InnerIterator entry(matrix, column); entry; ++entry)
            if (!lower_only || entry.row() >= entry.col()) visit(entry);
}

}  // namespace

void write_matrix_market(std::ostream& out, const Sparse& matrix) {
    const bool symmetric = is_symmetric(matrix);
    std::size_t n_entries = 0;
    visit_entries(matrix, symmetric, [&](const auto&) { ++n_entries; });
    out << "%%MatrixMarket matrix coordinate real " << (symmetric ? "symmetric" : "general") << "\n"
        << matrix.rows() << " " << matrix.cols() << " " << n_entries << "\n";
    visit_entries(matrix, symmetric, [&](const auto& entry) {
        out << entry.row() + 1 << " " << entry.col() + 1 << " " << exact(entry.value()) << "\n";
    });
}

}  // namespace elastolab
