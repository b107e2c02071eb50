#pragma once

#include <memory>

#include "bem/galerkin/finer_rims.hpp"
#include "bem/galerkin/hierarchical_system.hpp"
#include "deform/solid_model.hpp"

namespace elastolab {

/// A solid by symmetric Galerkin boundary elements as GalerkinModel, for surfaces whose dense matrix would be too
/// large: the operators are hierarchical, each constrained set is solved for by iteration. Memory and time grow a
/// little faster than the number of vertices. The updates `direct` and `reduced` solve alike; on demand only. With
/// finer rims (Method::rims) nothing is computed ahead: the operators are those of each set's own surface.
class HierarchicalGalerkinModel : public SolidModel {
public:
    /// before: as in GalerkinModel. Throws SolveError, Cancelled.
    HierarchicalGalerkinModel(const SurfaceMesh& surface, double poisson_ratio, const Method& method,
                              const HierarchicalGalerkinModel* before, Control& control);

    std::unique_ptr<ConstrainedSolid> constrain(std::span<const int> fixed, std::span<const int> handles,
                                                std::span<const UnitLoad> loads, Control& control) const override;
    std::uint64_t constrain_memory(std::span<const int> fixed, std::span<const int> handles) const override;
    std::uint64_t check_memory(std::span<const int> fixed, std::span<const int> handles) const override;
    void visit_matrices(const std::function<void(const NamedMatrix&)>&) const override {}

private:
    std::unique_ptr<ConstrainedSolid> constrain(std::shared_ptr<const HierarchicalSystem> system, const SurfaceSet& set,
                                                const SurfaceSet& of_body, Control& control) const;

    Method method_;
    std::shared_ptr<const SurfaceMesh> surface_;
    double poisson_ratio_;
    std::shared_ptr<const HierarchicalSystem> system_;  ///< null with finer rims
};

}  // namespace elastolab
