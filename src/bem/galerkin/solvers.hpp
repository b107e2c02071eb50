#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "bem/galerkin/system.hpp"
#include "deform/dense_solvers.hpp"
#include "deform/node_solver.hpp"
#include "deform/reduced_solver.hpp"

namespace elastolab {

/// Compliance columns of a solid to reactions R at its constrained vertices and tractions t, for the capacitance system
///   [ Z^T D^+ Z + diag(0, V)   (C^T Z)^T ] [ R; t ]   [ u_C; 0 ]
///   [ C^T Z                     0        ] [  c   ] = [   0    ],   u = D^+ Z [R; t] + C c
/// which is that of docs/formulation.md section 7: symmetric, and exact for any constrained set.
class GalerkinComplianceColumns : public ComplianceColumns {
public:
    GalerkinComplianceColumns(std::shared_ptr<const GalerkinSystem> system, std::vector<int> vertices,
                              GalerkinTractions tractions, std::span<const UnitLoad> loads, Control& control);

    Eigen::Index cols() const override { return columns_.cols(); }
    Eigen::Index n_given() const override { return given_.cols(); }
    Eigen::MatrixXd capacitance_matrix(const std::vector<int>& nodes, const Eigen::MatrixXd& rigid,
                                       Control& control) const override;
    void add_product(const Eigen::MatrixXd& loads, Eigen::Ref<Eigen::MatrixXd> displacements,
                     Control& control) const override;

private:
    std::shared_ptr<const GalerkinSystem> system_;
    std::vector<int> vertices_;
    GalerkinTractions tractions_;
    std::vector<UnitLoad> loads_;
    Columns columns_, given_;  ///< L^-1 Z over C^T Z, of the unknowns and of the given loads
};

/// Tractions and free displacements by elimination: with V = L_V L_V^T and Y = L_V^-1 K the free block D + Y^T Y is
/// symmetric positive definite. Factorised afresh for each constrained set.
class GalerkinDirectSolver : public NodeSolver {
public:
    /// D: GalerkinSystem::hypersingular. Throws NotHeldError when the constraints do not hold the body; SolveError,
    /// Cancelled.
    GalerkinDirectSolver(const GalerkinSystem& system, const Eigen::MatrixXd& D, const std::vector<int>& vertices,
                         const GalerkinTractions& tractions, std::span<const UnitLoad> loads, Control& control);
    /// loads: reactions at the vertices, then tractions.
    NodeSolution solve(const Eigen::MatrixXd& prescribed, bool want_loads) const override;

private:
    Partition partition_;
    CholeskyFactorization single_layer_, free_;
    Eigen::MatrixXd Y_;              ///< L_V^-1 K
    Eigen::MatrixXd given_forces_;   ///< of the given loads, at all nodes
    Eigen::MatrixXd given_;          ///< L_V^-1 V g
    Eigen::MatrixXd D_constrained_;  ///< rows of D at the constrained vertices
};

/// Bytes that it takes at its peak, D among them: scalar unknowns of the body, and tractions.
std::uint64_t galerkin_direct_memory(std::int64_t n_degrees_of_freedom, std::int64_t n_tractions);

/// Whether one answer by elimination takes at most two thirds of the arithmetic of the factor and the columns that
/// serve further sets too. All in scalars.
bool is_sooner_alone(std::int64_t n_degrees_of_freedom, std::int64_t n_prescribed, std::int64_t n_tractions);

/// The capacitance system of a constrained set, its compliance columns kept.
ReducedSystem galerkin_reduced_system(const std::shared_ptr<const GalerkinSystem>& system,
                                      const std::vector<int>& vertices, const GalerkinTractions& tractions,
                                      std::span<const UnitLoad> loads, Control& control);

}  // namespace elastolab
