#pragma once

#include <memory>

#include "bem/system.hpp"
#include "deform/solid_model.hpp"

namespace elastolab {

/// A solid by constant or linear boundary elements.
class BemModel : public SolidModel {
public:
    BemModel(const SurfaceMesh& surface, double poisson_ratio, const Method& method, Control& control);
    /// The same surface with another material or method; takes over the system or its integrals where they serve.
    BemModel(const BemModel& before, double poisson_ratio, const Method& method, Control& control);

    std::unique_ptr<ConstrainedSolid> constrain(std::span<const int> base, std::span<const int> handles,
                                                Control& control) const override;
    std::uint64_t constrain_memory(std::span<const int> base, std::span<const int> handles) const override;
    void visit_matrices(const std::function<void(const NamedMatrix&)>& visit) const override;

private:
    /// A constrained set in terms of nodes and loads.
    struct Setting {
        ConstrainedNodes nodes;
        LoadPlan plan;
        int n_base = 0;  ///< so many of the nodes rest
    };
    Setting setting_of(std::span<const int> base, std::span<const int> handles) const;
    /// Whether Eqns. 7 and 9 act on K itself: where one K serves every constrained set.
    bool has_K() const;
    void note_facts();
    SolutionChecks checks(const LoadPlan& plan, const std::vector<int>& nodes) const;
    std::unique_ptr<NodeSolver> make_solver(const LoadPlan& plan, const std::vector<int>& nodes, int n_base,
                                            Control& control) const;

    Method method_;
    double poisson_ratio_;
    std::shared_ptr<const BemSystem> system_;
    std::shared_ptr<const SparseRows> display_;  ///< constant elements only
};

}  // namespace elastolab
