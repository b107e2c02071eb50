#pragma once

#include <Eigen/Core>
#include <optional>

#include "fem/sparse_cholesky.hpp"
#include "fem/sparse_matrix.hpp"

namespace elastolab {

/// Displacements inside a solid from those of its surface: K_ii u_i = -K_is u_s, interior nodes free of load. One
/// factorisation, then a solve for each shape of the surface. Immutable; any thread may use it.
class InteriorExtension {
public:
    /// K: 3n x 3n, both triangles, surface nodes first. Throws SolveError.
    InteriorExtension(const SparseMatrix& K, int n_surface);
    /// 3*n_surface to 3n.
    Eigen::VectorXd extend(const Eigen::VectorXd& surface) const;

private:
    Eigen::Index n_all_, n_surface_;        ///< degrees of freedom
    SparseMatrix to_surface_;               ///< K_is
    std::optional<SparseCholesky> factor_;  ///< of K_ii; none without interior nodes
};

}  // namespace elastolab
