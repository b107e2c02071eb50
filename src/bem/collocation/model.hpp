#pragma once

#include <memory>

#include "bem/collocation/system.hpp"
#include "deform/solid_model.hpp"

namespace elastolab {

/// A solid by constant or linear boundary elements.
class BemModel : public SolidModel {
public:
    /// before: a model of the same surface, of which the boundary, the integrals or the whole system are taken over
    /// where they serve; or null.
    BemModel(const BoundaryElement& element, const SurfaceMesh& surface, double poisson_ratio, const Method& method,
             BemSystem::Storage storage, const BemModel* before, Control& control);

    std::unique_ptr<ConstrainedSolid> constrain(std::span<const int> fixed, std::span<const int> handles,
                                                std::span<const UnitLoad> loads, Control& control) const override;
    std::uint64_t constrain_memory(std::span<const int> fixed, std::span<const int> handles) const override;
    std::uint64_t check_memory(std::span<const int> fixed, std::span<const int> handles) const override;
    void visit_matrices(const std::function<void(const NamedMatrix&)>& visit) const override;

private:
    BemConstraints constraints_of(std::span<const int> fixed, std::span<const int> handles) const;
    /// Whether Eqns. 7 and 9 act on K itself: where one K serves every constrained set.
    bool has_K() const;
    void note_facts();
    SolutionChecks checks(const TractionSpace& space, std::vector<int> vertices, std::span<const UnitLoad> loads) const;
    std::unique_ptr<NodeSolver> make_solver(const TractionSpace& space, const std::vector<int>& nodes, int n_fixed,
                                            std::span<const UnitLoad> loads, Control& control) const;

    const BoundaryElement& element_;
    Method method_;
    BemSystem::Storage storage_;
    double poisson_ratio_;
    std::shared_ptr<const BemSystem> system_;
    std::shared_ptr<const SparseRows> display_;  ///< null where nodes are vertices
};

}  // namespace elastolab
