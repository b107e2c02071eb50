#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/timer.hpp"
#include "bem/galerkin/boundary_entries.hpp"
#include "bem/galerkin/cost.hpp"
#include "bem/galerkin/surfaces.hpp"
#include "bem/galerkin/traction_layers.hpp"
#include "bem/galerkin/tractions.hpp"
#include "bem/hierarchical/hierarchical_matrix.hpp"
#include "bem/hierarchical/recycled_solutions.hpp"
#include "bem/hierarchical/schwarz.hpp"
#include "deform/load_columns.hpp"
#include "deform/method.hpp"
#include "deform/node_solver.hpp"
#include "deform/unit_load.hpp"

namespace elastolab {

/// The hypersingular operator of one solid with unit Young's modulus, hierarchical: what the equations of
/// bem/galerkin/system.hpp are made of where the surface is large. Immutable; any thread may use it.
class HierarchicalSystem {
public:
    /// Throws Cancelled.
    HierarchicalSystem(const SurfaceMesh& surface, double poisson_ratio, const Method& method, StageTimes& stages,
                       Control& control);

    const Boundary& boundary() const { return pairs_->boundary(); }
    const std::shared_ptr<const BoundaryPairs>& pairs() const { return pairs_; }
    const std::shared_ptr<const ClusterTree>& tree() const { return tree_; }
    const ClosedSurfaces& surfaces() const { return surfaces_; }
    const HierarchicalMatrix& matrix() const { return *D_; }
    const Material& material() const { return material_; }
    const HierarchicalOptions& options() const { return options_; }
    Eigen::Index size() const { return 3 * tree_->size(); }
    std::uint64_t memory_bytes() const { return D_->memory_bytes(); }
    /// (B - K)^T g of given loads at all vertices, node-major, and V g on the tractions of a set: integrated together
    /// once, and kept. Throws Cancelled.
    Eigen::MatrixXd given_nodal_forces(std::span<const UnitLoad> loads, Control& control) const;
    Eigen::MatrixXd given_single_layer(const GalerkinTractions& tractions, std::span<const UnitLoad> loads,
                                       Control& control) const;

    /// Rigid motions, orthonormal, rows in the order of the tree: of each closed surface, and of the whole body.
    const Eigen::MatrixXd& surface_modes() const { return surface_modes_; }
    const Eigen::MatrixXd& body_modes() const { return body_modes_; }
    /// P D P X with P = 1 - C C^T: freed of what integrals and approximation leave of the rigid motions.
    Eigen::MatrixXd hypersingular(const Eigen::MatrixXd& X) const;
    /// V and K at some triangles; what living ones have is taken over. Throws Cancelled.
    std::shared_ptr<const TriangleLayers> layers_of(const std::vector<int>& triangles, Control& control) const;

private:
    Eigen::MatrixXd given_layers(std::span<const UnitLoad> loads, Control& control) const;

    std::shared_ptr<const BoundaryPairs> pairs_;
    std::shared_ptr<const ClusterTree> tree_;
    ClosedSurfaces surfaces_;
    Material material_;
    HierarchicalOptions options_;
    Eigen::MatrixXd surface_modes_, body_modes_;
    std::unique_ptr<const HierarchicalMatrix> D_;
    mutable LivingLayers<TriangleLayers> living_;
    mutable ColumnCache given_{kLoadColumnBytes};
};

/// Displacements and tractions of one constrained set by elimination of the tractions: the free block of
/// D + K^T V^-1 K is symmetric positive definite and solved by preconditioned conjugate gradients. Answers are kept:
/// prescribed displacements that are a combination of earlier ones cost no iteration.
class HierarchicalSolver : public NodeSolver {
public:
    /// Where the constraints leave a rigid motion free, the solution that moves least is taken; with `must_hold`
    /// NotHeldError is thrown. The single layer is factorised up to `most_factorised` tractions. Throws SolveError,
    /// Cancelled.
    HierarchicalSolver(std::shared_ptr<const HierarchicalSystem> system, std::vector<int> vertices,
                       const GalerkinTractions& tractions, std::span<const UnitLoad> loads, bool must_hold,
                       Control& control, std::int64_t most_factorised = kMostFactorisedTractions);

    /// loads: reactions at the vertices, then tractions.
    NodeSolution solve(const Eigen::MatrixXd& prescribed, bool want_loads) const override;
    NodeSolution solve_watched(const Eigen::MatrixXd& prescribed, bool want_loads, double tolerance,
                               Control& control) const override;
    bool iterates() const override { return true; }

    const TractionLayers& layers() const { return *layers_; }

private:
    class FreeBlock;

    /// Displacements in the order of the tree.
    Eigen::MatrixXd displacements(const Eigen::MatrixXd& prescribed, double tolerance, Control& control) const;
    Eigen::MatrixXd iterate(const Eigen::MatrixXd& prescribed, Eigen::MatrixXd start, double tolerance,
                            Control& control) const;
    Eigen::MatrixXd operate(const Eigen::MatrixXd& u, double inner, Control& control) const;
    Eigen::MatrixXd double_layer(Eigen::MatrixXd u) const;
    Eigen::MatrixXd transposed_double_layer(const Eigen::MatrixXd& t) const;
    /// factors: of the given loads, or none.
    Eigen::MatrixXd tractions_of(const Eigen::MatrixXd& u, const Eigen::MatrixXd& factors, double tolerance,
                                 Control& control) const;
    Eigen::MatrixXd factors_of(const Eigen::MatrixXd& prescribed) const {
        return prescribed.bottomRows(given_forces_.cols());
    }
    void zero_constrained(Eigen::MatrixXd& rows) const;

    std::shared_ptr<const HierarchicalSystem> system_;
    std::vector<int> vertices_, positions_;  ///< constrained
    std::unique_ptr<const TractionLayers> layers_;
    std::unique_ptr<const SchwarzPreconditioner> preconditioner_;
    Eigen::MatrixXd given_forces_, given_layer_;  ///< of the given loads: (B - K)^T g at all vertices, V g
    Eigen::MatrixXd free_modes_;  ///< rigid motions that the constraints leave, orthonormal; mostly none
    mutable RecycledSolutions recycled_;
};

}  // namespace elastolab
