#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "deform/dense_solvers.hpp"
#include "deform/solid_model.hpp"
#include "fem/solvers.hpp"

namespace elastolab {

/// A solid by linear or quadratic tetrahedra. All modes show the surface vertices, which are the first nodes of the
/// mesh. Quadratic elements are meant for the mode on_demand: the others would keep dense matrices of all nodes on the
/// surface, four times as many as its vertices.
class FemModel : public SolidModel {
public:
    /// Throws MeshError when the surface cannot be filled with tetrahedra; `name` is that of the body.
    FemModel(const SurfaceMesh& surface, const std::string& name, double poisson_ratio, const Method& method,
             Control& control, ElementDegree degree = ElementDegree::linear);
    /// The same tetrahedra with another material or method: nothing is integrated.
    FemModel(const FemModel& before, double poisson_ratio, const Method& method, Control& control);

    std::unique_ptr<ConstrainedSolid> constrain(std::span<const int> fixed, std::span<const int> handles,
                                                std::span<const UnitLoad> loads, Control& control) const override;
    std::uint64_t constrain_memory(std::span<const int> fixed, std::span<const int> handles) const override;
    std::uint64_t check_memory(std::span<const int> fixed, std::span<const int> handles) const override;
    void visit_matrices(const std::function<void(const NamedMatrix&)>& visit) const override;
    const SparseStiffness* sparse_stiffness() const override { return &system_->K; }
    std::optional<Interior> interior() const override;

    ElementDegree degree() const { return mesh_->degree(); }

private:
    /// How the update `reduced` treats a set on demand.
    enum class Elimination {
        fixed,    ///< the capacitance system of the handles, on the body with its fixed set eliminated
        nothing,  ///< that of all vertices, on the free body
        all       ///< none: a factorisation with all of them eliminated
    };

    void precompute(double poisson_ratio, Control& control);
    Elimination cheapest_elimination(const ConstrainedFemNodes& nodes) const;
    /// That of this model's update.
    Elimination elimination_of(const ConstrainedFemNodes& nodes) const;
    std::shared_ptr<const FactorisedBody> at_hand(std::span<const int> fixed) const;
    using Loads = std::span<const UnitLoad>;
    std::unique_ptr<ConstrainedSolid> constrain_dense(ConstrainedFemNodes nodes, Loads loads, Control& control) const;
    std::unique_ptr<ConstrainedSolid> constrain_direct(ConstrainedFemNodes nodes, Loads loads, Control& control) const;
    std::unique_ptr<ConstrainedSolid> constrain_reduced(ConstrainedFemNodes nodes, Loads loads, int n_eliminated,
                                                        Control& control) const;
    /// The second answer that a solution is judged by (fem/error_estimate.hpp); held: the factor, where it is kept.
    decltype(SolutionChecks::reference) reference_for(
        const ConstrainedFemNodes& nodes, Loads loads,
        const std::shared_ptr<const SparseCholesky>& held = nullptr) const;
    /// Nodal forces of unit loads at the nodes of the dense operators: those of inside nodes condensed.
    Eigen::MatrixXd dense_load_vectors(Loads loads, Control& control) const;
    ConstrainedFemNodes nodes_of(std::span<const int> fixed, std::span<const int> handles) const;
    std::unique_ptr<ConstrainedSolid> make_solid(ConstrainedFemNodes nodes, std::unique_ptr<NodeSolver> solver,
                                                 SolutionChecks checks, Loads loads) const;
    std::shared_ptr<const FactorisedBody> factorised_on(std::span<const int> fixed, Control& control) const;

    Method method_;
    double poisson_ratio_ = 0.0;
    std::shared_ptr<const FemMesh> mesh_;
    std::shared_ptr<const FemSystem> system_;
    std::shared_ptr<const DenseOperators> operators_;  ///< modes full and full_volume
    /// On demand: the body free, and with the fixed set eliminated that was asked for last. Large ones are not both
    /// kept. Who asks only what is at hand never waits for a factorisation: that has a lock of its own.
    mutable std::mutex factorising_mutex_;
    mutable std::mutex factorised_mutex_;  ///< for the next two; held for no longer than it takes to copy them
    mutable std::shared_ptr<const FactorisedBody> free_body_, factorised_body_;
};

/// MethodTraits::precompute of elements of this degree: takes over the tetrahedra of a model of the same degree.
template <ElementDegree degree>
std::shared_ptr<const SolidModel> precompute_fem(const SurfaceMesh& surface, const std::string& name,
                                                 double poisson_ratio, const Method& method, const SolidModel* before,
                                                 Control& control) {
    if (const auto* fem = dynamic_cast<const FemModel*>(before); fem != nullptr && fem->degree() == degree)
        return std::make_shared<FemModel>(*fem, poisson_ratio, method, control);
    return std::make_shared<FemModel>(surface, name, poisson_ratio, method, control, degree);
}

}  // namespace elastolab
