#pragma once

#include <memory>
#include <optional>

#include "bem/cost.hpp"
#include "bem/galerkin/finer_rims.hpp"
#include "bem/galerkin/hierarchical_model.hpp"
#include "bem/galerkin/system.hpp"
#include "deform/solid_model.hpp"

namespace elastolab {

/// A solid by symmetric Galerkin boundary elements: displacements linear on triangles, tractions constant on
/// constrained ones. A constrained vertex without a constrained triangle has a reaction and no traction. With finer
/// rims (Method::rims) each set is solved on a surface of its own, by hierarchical matrices where that is large.
class GalerkinModel : public SolidModel {
public:
    /// before: a model of the same surface, from which all that still serves is taken over, or null. Throws SolveError,
    /// Cancelled.
    GalerkinModel(const SurfaceMesh& surface, double poisson_ratio, const Method& method, const GalerkinModel* before,
                  Control& control);

    std::unique_ptr<ConstrainedSolid> constrain(std::span<const int> fixed, std::span<const int> handles,
                                                std::span<const UnitLoad> loads, Control& control) const override;
    std::uint64_t constrain_memory(std::span<const int> fixed, std::span<const int> handles) const override;
    bool serves_sets() const override { return system_->serves_sets(); }
    std::uint64_t check_memory(std::span<const int> fixed, std::span<const int> handles) const override;
    void visit_matrices(const std::function<void(const NamedMatrix&)>& visit) const override;

private:
    /// D: the hypersingular matrix, for a factorisation of this set alone; without one, from compliance columns.
    /// of_body: the same set on the body's own surface.
    std::unique_ptr<ConstrainedSolid> constrain(std::shared_ptr<const GalerkinSystem> system,
                                                std::optional<Eigen::MatrixXd> D, const SurfaceSet& set,
                                                const SurfaceSet& of_body, Control& control) const;
    /// By itself, with the D that is there; null where that is not sooner, or it is not the first.
    std::unique_ptr<ConstrainedSolid> first_set(const SurfaceSet& given, Control& control) const;
    std::unique_ptr<ConstrainedSolid> constrained(std::shared_ptr<const GalerkinSystem> system,
                                                  std::unique_ptr<NodeSolver> solver,
                                                  const GalerkinTractions& tractions, const SurfaceSet& set,
                                                  const SurfaceSet& of_body) const;
    /// Throws NotHeldError when the set does not hold the body.
    std::unique_ptr<ConstrainedSolid> constrain_with_finer_rims(const SurfaceSet& given, Control& control) const;
    /// Of the same body, for sets whose own surface is large.
    bool is_large(const FinerRims& rims) const { return is_hierarchical(rims.surface.mesh, method_); }
    HierarchicalGalerkinModel for_large_sets() const;

    Method method_;
    double poisson_ratio_;
    std::shared_ptr<const GalerkinSystem> system_;
};

}  // namespace elastolab
