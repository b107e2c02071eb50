#pragma once

#include <Eigen/Core>
#include <optional>

#include "base/control.hpp"
#include "fem/sparse_cholesky.hpp"
#include "fem/sparse_matrix.hpp"

namespace elastolab {

/// K_ii u_i = f_i - K_is u_s; interior nodes are free of load where none is given. One factorisation, then a solve for
/// each shape of the surface.
class FemInterior {
public:
    /// K: 3n x 3n over all nodes, both triangles; of them the first n_given are given. Throws SolveError, Cancelled.
    FemInterior(const SparseMatrix& K, int n_given, Control& control);
    /// Displacements of all nodes from those that are given. loads: of all nodes, or empty.
    Eigen::MatrixXd extend(const Eigen::MatrixXd& surface, const Eigen::MatrixXd& loads = {}) const;
    /// f_s - K_si K_ii^-1 f_i: the loads on the surface that move it as loads on all nodes do.
    Eigen::MatrixXd condensed(const Eigen::MatrixXd& loads) const;

private:
    Eigen::Index n_all_, n_surface_;        ///< degrees of freedom
    SparseMatrix to_surface_;               ///< K_is
    std::optional<SparseCholesky> factor_;  ///< of K_ii; none without interior nodes
};

}  // namespace elastolab
