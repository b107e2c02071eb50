#pragma once

#include <atomic>
#include <cstdint>
#include <Eigen/Core>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "base/cholesky.hpp"
#include "base/control.hpp"
#include "base/timer.hpp"
#include "bem/galerkin/hypersingular.hpp"
#include "bem/galerkin/tractions.hpp"
#include "deform/load_columns.hpp"
#include "deform/method.hpp"
#include "deform/unit_load.hpp"
#include "mesh/refine.hpp"

namespace elastolab {

/// The hypersingular matrix and its pseudo-inverse.
struct DenseHypersingular {
    Eigen::MatrixXd D, pseudo_inverse;  ///< 3V square, zero for rigid motions of each closed surface
};

/// The symmetric Galerkin equations of one solid with unit Young's modulus (docs/formulation.md section 7):
///   V t = K u  on the tractions of a constrained set,    D u + K^T t = R,   R zero at free vertices
/// D is projected so as to annihilate the rigid motions C of each closed surface to rounding, and factorised once as
///   D + a C C^T = L L^T,  so that its pseudo-inverse is  D^+ = (L L^T)^-1 - C C^T / a.
/// R is the reaction: the derivative of the energy with respect to the prescribed displacements. Any thread may use it.
class GalerkinSystem {
public:
    /// On demand with the update `direct` nothing is factorised here; with finer rims D is integrated and kept. With
    /// Method::first_set_alone D is kept until factorise().
    /// `parts`: D's integrals of this boundary and tolerance, or null.
    GalerkinSystem(std::shared_ptr<const Boundary> boundary, double poisson_ratio, const Method& method,
                   std::shared_ptr<const HypersingularParts> parts, StageTimes& stages, Control& control);

    const Boundary& boundary() const { return *boundary_; }
    std::shared_ptr<const Boundary> shared_boundary() const { return boundary_; }
    const ClosedSurfaces& surfaces() const { return surfaces_; }
    std::shared_ptr<const HypersingularParts> parts() const { return parts_; }
    const Material& material() const { return material_; }
    double tolerance() const { return tolerance_; }
    Eigen::Index size() const { return 3 * boundary_->mesh().n_vertices(); }
    /// Whether the factor is there, which columns and their products need.
    bool is_factorised() const { return is_factorised_; }
    /// Makes it where it is not there yet. Throws SolveError, Cancelled.
    void factorise(Control& control) const;
    /// Of the factor; nothing while there is none.
    std::optional<double> reciprocal_condition() const {
        return is_factorised() ? std::optional(factor_.reciprocal_condition()) : std::nullopt;
    }
    /// Of a system that was not factorised ahead: calls solve(D) for a first constrained set, D freed of rigid motions.
    /// False for any other set: nothing is called. Throws Cancelled, and what solve throws.
    bool solve_first_set(const std::function<void(const Eigen::MatrixXd& D)>& solve, const Control& control) const;
    /// False after solve_first_set, until factorise().
    bool serves_sets() const { return is_factorised_ || !solved_first_set_; }
    std::uint64_t memory_bytes() const;

    /// D afresh, both triangles, freed of rigid motions.
    Eigen::MatrixXd hypersingular(Control& control) const;
    /// The same of a system on a refined surface. coarse: that of the body, which keeps D.
    Eigen::MatrixXd hypersingular(const GalerkinSystem& coarse, const RefinedSurface& fine, Control& control) const;
    /// V and K of a traction space, integrated afresh.
    GalerkinOperators operators(const GalerkinTractions& tractions, Control& control) const;
    /// V alone: pairs of its own triangles.
    Eigen::MatrixXd single_layer(const GalerkinTractions& tractions, Control& control) const;

    /// L^-1 Z over C^T Z, with Z = [I at these vertices, -K^T of the tractions]; computed once, kept within a budget.
    Columns half_columns(std::span<const int> vertices, const GalerkinTractions& tractions, Control& control) const;
    /// The same for given loads: Z = (B - K)^T g, a column each.
    Columns half_load_columns(std::span<const UnitLoad> loads, Control& control) const;
    /// (B - K)^T g of given loads at all nodes, and V g on the tractions of a set: integrated together once, and kept.
    Eigen::MatrixXd given_nodal_forces(std::span<const UnitLoad> loads, Control& control) const;
    Eigen::MatrixXd given_single_layer(const GalerkinTractions& tractions, std::span<const UnitLoad> loads,
                                       Control& control) const;
    /// u <- D^+ Z q from y = (L^-1 Z) q and f = (C^T Z) q.
    void finish(Eigen::MatrixXd& y, const Eigen::MatrixXd& f) const;
    /// a. With Y = L^-1 Z and F = C^T Z: Z^T D^+ Z = Y^T Y - F^T F / a.
    double shift() const { return shift_; }

    /// Only in the mode `full`, else null.
    std::shared_ptr<const DenseHypersingular> dense() const { return dense_; }

private:
    /// D as integrated, not yet projected.
    Eigen::MatrixXd integrals(Control& control) const;
    void take_factor(Eigen::MatrixXd&& D, Control& control) const;
    void complete(Eigen::MatrixXd D, StageTimes& stages, Control& control);
    std::vector<Columns::Block> compute(const std::vector<ColumnKey>& missing, Control& control) const;
    void free_of_rigid_motions(Eigen::MatrixXd& K) const;
    Eigen::MatrixXd given_layers(std::span<const UnitLoad> loads, Control& control) const;

    std::shared_ptr<const Boundary> boundary_;
    Material material_;
    double tolerance_;
    ClosedSurfaces surfaces_;
    Eigen::MatrixXd body_modes_;  ///< 3V x 6: rigid motions of the whole body
    std::shared_ptr<const HypersingularParts> parts_;
    Eigen::MatrixXd integrals_;  ///< D as integrated, kept for sets with finer rims
    bool keeps_matrix_;          ///< D, or its factor
    double shift_ = 1.0;
    mutable std::mutex factor_mutex_;
    mutable Eigen::MatrixXd unfactorised_;  ///< D freed of rigid motions
    mutable CholeskyFactorization factor_;
    mutable std::atomic<bool> is_factorised_ = false, solved_first_set_ = false;
    std::shared_ptr<const DenseHypersingular> dense_;
    std::unique_ptr<ColumnCache> cache_;
    mutable ColumnCache given_{kLoadColumnBytes};
};

/// Bytes of half compliance columns for a constrained set, and of the capacitance system made from them.
std::uint64_t half_column_memory(const GalerkinSystem& system, Eigen::Index n_degrees_of_freedom);

}  // namespace elastolab
