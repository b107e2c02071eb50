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
/// zero. D annihilates the rigid motions of each closed surface by itself: a patch that has all of a small surface is
/// regularised by these, and what they cost all the same is given to the preconditioner (`loose`). The number of
/// iterations hardly depends on the number of vertices. Source: M. Ainsworth and B. Guo, Numer. Math. 85 (2000), for
/// hypersingular operators.
class SchwarzPreconditioner : public LinearOperator {
public:
    /// is_free            by position in the tree
    /// surface_modes    rigid motions of each closed surface, orthonormal, six columns each, rows in tree order
    /// loose              orthonormal combinations of these that vanish at the constrained vertices
    /// loose_energies     of them, without D's part: symmetric, positive semidefinite
    /// Throws SolveError when D is not positive definite on a patch, Cancelled.
    SchwarzPreconditioner(const HierarchicalMatrix& D, const Boundary& boundary, std::vector<char> is_free,
                          const Eigen::MatrixXd& surface_modes, const Eigen::MatrixXd& loose,
                          const Eigen::MatrixXd& loose_energies, Control& control);

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
    Eigen::MatrixXd loose_;  ///< motions of unit energy: their part is loose_ loose_^T
};

}  // namespace elastolab
