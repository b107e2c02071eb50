#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/cholesky.hpp"
#include "bem/galerkin/tractions.hpp"
#include "bem/galerkin/triangle_layers.hpp"
#include "deform/linear_operator.hpp"

namespace elastolab {

class HierarchicalSystem;

/// V and K of the tractions of one constrained set (bem/galerkin/system.hpp), hierarchical. Tractions are in the order
/// of GalerkinTractions, displacements in that of the vertices' cluster tree.
class TractionLayers {
public:
    /// V is factorised up to `most_factorised` tractions. Throws SolveError, Cancelled.
    TractionLayers(const HierarchicalSystem& system, const GalerkinTractions& tractions, std::int64_t most_factorised,
                   Control& control);
    ~TractionLayers();

    Eigen::Index size() const { return size_; }
    /// Triangles that were integrated for this set.
    int n_new_triangles() const { return layers_ ? layers_->n_new_triangles() : 0; }
    /// K u, K^T t, V t
    Eigen::MatrixXd double_layer(const Eigen::MatrixXd& u) const;
    Eigen::MatrixXd transposed_double_layer(const Eigen::MatrixXd& t) const;
    Eigen::MatrixXd single_layer(const Eigen::MatrixXd& t) const;
    /// V^-1 b: by a factor where that is small, else by conjugate gradients to this residual. Throws SolveError,
    /// Cancelled.
    Eigen::MatrixXd solve_single_layer(const Eigen::MatrixXd& b, double tolerance, Control& control) const;

    /// Null where there are no tractions.
    std::uint64_t memory_bytes() const;

private:
    class SingleLayer;
    class PatchSolves;

    Eigen::MatrixXd dense_single_layer() const;
    /// Tractions on each triangle from the unknowns, and the transpose of that.
    Eigen::MatrixXd spread(const Eigen::MatrixXd& t) const;
    Eigen::MatrixXd gather(const Eigen::MatrixXd& on_triangles) const;

    Eigen::Index size_ = 0, n_single_ = 0;
    std::vector<Eigen::MatrixXd> rigid_;  ///< fields of the surfaces without constrained triangles
    std::shared_ptr<const TriangleLayers> layers_;
    CholeskyFactorization factor_;
    std::unique_ptr<const LinearOperator> operator_, subdomain_solves_;  ///< of V, where it is not factorised
};

}  // namespace elastolab
