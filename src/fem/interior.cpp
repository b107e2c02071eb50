#include "fem/interior.hpp"

#include <cassert>
#include <vector>

namespace elastolab {

namespace {

SparseMatrix block(const SparseMatrix& K, Eigen::Index column, Eigen::Index n_columns, Eigen::Index row) {
    const SparseMatrix columns = K.middleCols(column, n_columns);
    std::vector<Eigen::Triplet<double, int>> entries;
    for (int j = 0; j < columns.outerSize(); ++j)
        for (SparseMatrix::InnerIterator i(columns, j); i; ++i)
            if (i.row() >= row) entries.emplace_back(static_cast<int>(i.row() - row), j, i.value());
    SparseMatrix result(K.rows() - row, n_columns);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

SparseCholesky factorised(const SparseMatrix& K_ii, Control& control) {
    return SparseCholesky(CholeskyAnalysis(K_ii), K_ii, "stiffness matrix of the interior nodes", &control);
}

}  // namespace

FemInterior::FemInterior(const SparseMatrix& K, int n_given, Control& control)
    : n_all_(K.rows()), n_surface_(3 * n_given), to_surface_(block(K, 0, n_surface_, n_surface_)) {
    if (n_all_ > n_surface_) factor_ = factorised(block(K, n_surface_, n_all_ - n_surface_, n_surface_), control);
}

Eigen::MatrixXd FemInterior::condensed(const Eigen::MatrixXd& loads) const {
    Eigen::MatrixXd f = loads.topRows(n_surface_);
    if (factor_) f -= to_surface_.transpose() * factor_->solve(loads.bottomRows(n_all_ - n_surface_));
    return f;
}

Eigen::MatrixXd FemInterior::extend(const Eigen::MatrixXd& surface, const Eigen::MatrixXd& loads) const {
    assert(surface.rows() == n_surface_);
    Eigen::MatrixXd all(n_all_, surface.cols());
    all.topRows(n_surface_) = surface;
    if (!factor_) return all;
    Eigen::MatrixXd right = -(to_surface_ * surface);
    if (loads.size() > 0) right += loads.bottomRows(right.rows());
    all.bottomRows(right.rows()) = factor_->solve(right);
    return all;
}

}  // namespace elastolab
