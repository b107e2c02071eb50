#pragma once

#include <memory>
#include <mutex>

#include "deform/solid_model.hpp"
#include "fem/quadratic_mesh.hpp"
#include "fem/solvers.hpp"
#include "petsc/node_solvers.hpp"

namespace elastolab {

/// A solid by linear or quadratic tetrahedra, whose stiffness lies on the processes of the Session: FemModel's mode
/// on_demand with the update direct; where the constraints do not hold the body, the reduced one. Used on the first
/// process alone, where the tetrahedra and the vectors are, and by one thread. One constrained set at a time: the
/// solver of the one before is given up.
class PetscFemModel : public SolidModel {
public:
    /// Throws as FemModel does.
    PetscFemModel(const SurfaceMesh& surface, const std::string& name, double poisson_ratio, const Method& method,
                  Control& control, ElementDegree degree);

    /// The same for another update; shares the stiffness.
    PetscFemModel(const PetscFemModel& before, const Method& method);

    std::unique_ptr<ConstrainedSolid> constrain(std::span<const int> fixed, std::span<const int> handles,
                                                std::span<const UnitLoad> loads, Control& control) const override;
    std::uint64_t constrain_memory(std::span<const int> fixed, std::span<const int> handles) const override;
    std::uint64_t check_memory(std::span<const int> fixed, std::span<const int> handles) const override;
    void visit_matrices(const std::function<void(const NamedMatrix&)>&) const override {}
    /// Assembled on this process when it is asked for.
    const SparseStiffness* sparse_stiffness() const override;
    std::optional<Interior> interior() const override;

    const SolverFacts& solver_facts() const { return stiffness_->facts(); }
    ElementDegree degree() const { return mesh_->degree(); }
    double poisson_ratio() const { return poisson_ratio_; }

private:
    using Values = const Eigen::VectorXd&;
    std::optional<ReferenceAnswer> better_answer(const std::vector<int>& vertices, std::span<const UnitLoad> loads,
                                                 Values values, Control& control) const;
    std::optional<ReferenceAnswer> halved_answer(const std::vector<int>& vertices, std::span<const UnitLoad> loads,
                                                 Values values, Control& control) const;

    double poisson_ratio_;
    Update update_;
    std::shared_ptr<const TetMesh> tets_;  ///< of the corners
    std::shared_ptr<const FemMesh> mesh_;  ///< of the elements; no integrals
    std::shared_ptr<PetscStiffness> stiffness_;
    mutable std::once_flag assembled_once_;
    mutable SparseStiffness assembled_;
};

}  // namespace elastolab
