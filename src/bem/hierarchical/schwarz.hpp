#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "base/control.hpp"
#include "bem/boundary.hpp"
#include "bem/hierarchical/hierarchical_matrix.hpp"
#include "deform/linear_operator.hpp"

namespace elastolab {

/// Additive Schwarz preconditioner of the free block of D in two levels: overlapping patches of vertices, each solved
/// for by itself (in single precision), and rigid motions of all patches together. Rows at constrained vertices stay
/// zero. The number of iterations hardly depends on the number of vertices. Source: M. Ainsworth and B. Guo, Numer.
/// Math. 85 (2000), for hypersingular operators.
class SchwarzPreconditioner : public LinearOperator {
public:
    /// is_free: by position in the tree. Throws SolveError when D is not positive definite on a patch, Cancelled.
    SchwarzPreconditioner(const HierarchicalMatrix& D, const Boundary& boundary, std::vector<char> is_free,
                          Control& control);

    Eigen::Index size() const override { return 3 * std::ssize(is_free_); }
    Eigen::MatrixXd product(const Eigen::MatrixXd& X) const override;

private:
    struct Patch {
        std::vector<int> positions;  ///< free, ascending
        Eigen::LLT<Eigen::MatrixXf> factor;
    };

    std::vector<char> is_free_;
    std::vector<Patch> patches_;
    Eigen::SparseMatrix<double, Eigen::RowMajor> coarse_;  ///< rigid motions of the patches, times a partition of unity
    Eigen::LLT<Eigen::MatrixXd> coarse_factor_;
};

}  // namespace elastolab
