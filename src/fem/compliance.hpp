#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "base/control.hpp"
#include "fem/constraints.hpp"
#include "fem/sparse_cholesky.hpp"
#include "fem/sparse_matrix.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Compliance D of one connected solid on its surface nodes: displacements of the surface for loads on the surface,
/// interior nodes free of load; symmetric. One factorisation; columns by sparse solves, on demand. Keeps no columns.
///
/// Without a fixed set, K is singular and D is the block of the bordered inverse (docs/formulation.md section 2) of the
/// condensed stiffness S with B = C = R, the orthonormal rigid modes of the surface nodes:
///   | S   R |^-1   | D    R |
///   | R^T 0 |    = | R^T  0 |,     D = S^+ (pseudo-inverse) = P K_g^-1 P,   P = I - R R^T
/// K_g is K on six statically determinate springs; P e_j is in equilibrium, so that the springs carry nothing and D
/// does not depend on where they are. With a fixed set (nodes fixed at zero), D = K_ff^-1, zero in rows and columns of
/// the fixed set, and there is no R.
///
/// A block of D between few vertices needs no columns of D, only a forward substitution over the rows that they reach.
///
/// Immutable; any thread may use it.
class SurfaceCompliance {
public:
    /// K          3n x 3n stiffness, both triangles; `analysis` of its pattern, shared by all bases and materials
    /// positions  3 x n, the first n_surface nodes are those of the surface
    /// fixed       surface nodes; empty, or holds(positions, fixed) (asserted)
    /// Throws SolveError, Cancelled.
    SurfaceCompliance(const SparseMatrix& K, const CholeskyAnalysis& analysis, const Positions& positions,
                      int n_surface, std::span<const int> fixed, Control& control);
    /// The same without a fixed set, on a support of the caller's choice; the result is the same to rounding.
    static SurfaceCompliance supported_at(const StaticSupport& support, const SparseMatrix& K,
                                          const CholeskyAnalysis& analysis, const Positions& positions, int n_surface,
                                          Control& control);

    int n_surface() const { return n_surface_; }

    /// Columns of D for these surface vertices: 3*n_surface x 3*vertices.size() [L / force]. Blocks of columns in
    /// parallel, checkpoints between them; the result does not depend on the number of threads.
    Eigen::MatrixXd columns(std::span<const int> vertices, Control& control) const;
    /// Rows and columns of D for these surface vertices: 3*vertices.size() square, symmetric.
    Eigen::MatrixXd block(std::span<const int> vertices, Control& control) const;
    /// D * loads, loads 3*n_surface x m.
    Eigen::MatrixXd apply(const Eigen::MatrixXd& loads, Control& control) const;

    /// Displacements of all nodes for loads on the surface, or on all nodes, 3n x m: interior nodes too. Without a
    /// fixed set the loads must be in equilibrium, and the result is so up to a rigid motion.
    Eigen::MatrixXd volume_columns(const Eigen::MatrixXd& loads) const;

    /// R: 3*n_surface x 6 with orthonormal columns; with a fixed set 3*n_surface x 0.
    const Eigen::MatrixXd& rigid() const { return rigid_; }
    /// 1-norm estimate for the factorised matrix (K_g or K_ff with its diagonal for the fixed set).
    double reciprocal_condition() const { return factor_.reciprocal_condition(); }
    std::uint64_t memory_bytes() const;

private:
    SurfaceCompliance(int n_surface, std::span<const int> fixed, const Positions& positions, SparseCholesky factor);

    /// D times the block of loads, in place of it: one sparse solve on the calling thread.
    void apply_block(Eigen::Ref<Eigen::MatrixXd> block) const;

    int n_surface_;
    std::vector<int> fixed_;
    Eigen::MatrixXd rigid_;
    SparseCholesky factor_;
    Eigen::MatrixXd rigid_columns_;  ///< K_g^-1 R at the surface nodes; without a fixed set
};

}  // namespace elastolab
