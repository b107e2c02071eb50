#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "base/control.hpp"
#include "deform/interior.hpp"
#include "fem/sparse_cholesky.hpp"
#include "fem/sparse_matrix.hpp"

namespace elastolab {

/// K_ii u_i = f_i - K_is u_s; interior nodes are free of load where none is given. One factorisation, then a solve for
/// each shape of the surface.
class FemInterior : public Interior {
public:
    /// K: 3n x 3n over the nodes of `tets`, both triangles. Throws SolveError, Cancelled.
    FemInterior(std::shared_ptr<const TetMesh> tets, const SparseMatrix& K, Control& control)
        : FemInterior(tets, K, tets->n_surface_vertices, control) {}
    /// The same where the first n_given nodes are given.
    FemInterior(std::shared_ptr<const TetMesh> tets, const SparseMatrix& K, int n_given, Control& control);
    const TetMesh& tetrahedra() const override { return *tets_; }
    Eigen::VectorXd extend(const Eigen::VectorXd& surface) const override { return extend_all(surface); }
    /// loads: of all nodes, or empty.
    Eigen::MatrixXd extend_all(const Eigen::MatrixXd& surface, const Eigen::MatrixXd& loads = {}) const;
    /// f_s - K_si K_ii^-1 f_i: the loads on the surface that move it as loads on all nodes do.
    Eigen::MatrixXd condensed(const Eigen::MatrixXd& loads) const;

private:
    std::shared_ptr<const TetMesh> tets_;
    Eigen::Index n_all_, n_surface_;        ///< degrees of freedom
    SparseMatrix to_surface_;               ///< K_is
    std::optional<SparseCholesky> factor_;  ///< of K_ii; none without interior nodes
};

}  // namespace elastolab
