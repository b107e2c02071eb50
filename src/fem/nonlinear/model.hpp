#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "deform/solid_model.hpp"
#include "fem/constrained_nodes.hpp"
#include "fem/nonlinear/mesh.hpp"
#include "fem/nonlinear/solver.hpp"

namespace elastolab {

/// A solid of a compressible neo-Hookean material under large deformations, by tetrahedra of ten nodes or four
/// (Method::elements).
class NonlinearModel : public SolidModel {
public:
    /// Throws MeshError when the surface cannot be filled with tetrahedra; `name` is that of the body.
    NonlinearModel(const SurfaceMesh& surface, const std::string& name, double poisson_ratio, const Method& method,
                   Control& control);
    /// The same elements of another material.
    NonlinearModel(const NonlinearModel& before, double poisson_ratio);

    std::unique_ptr<ConstrainedSolid> constrain(std::span<const int> fixed, std::span<const int> handles,
                                                std::span<const UnitLoad> loads, Control& control) const override;
    std::uint64_t constrain_memory(std::span<const int> fixed, std::span<const int> handles) const override;
    std::uint64_t check_memory(std::span<const int> fixed, std::span<const int> handles) const override;
    void visit_matrices(const std::function<void(const NamedMatrix&)>&) const override {}
    /// The tangent at rest.
    const SparseStiffness* sparse_stiffness() const override;
    std::optional<Interior> interior() const override;

    ElementDegree degree() const { return mesh_->elements->degree(); }

private:
    Material material() const { return {1.0, poisson_ratio_}; }

    double poisson_ratio_;
    std::shared_ptr<const NonlinearMesh> mesh_;
    std::uint64_t factor_bytes_ = 0, tangent_bytes_ = 0;  ///< of the free body
    mutable std::mutex rest_mutex_;
    mutable std::unique_ptr<const SparseStiffness> rest_;  ///< made when it is asked for
};

/// MethodTraits::precompute: takes over the tetrahedra of a model of the same degree.
std::shared_ptr<const SolidModel> precompute_nonlinear(const SurfaceMesh& surface, const std::string& name,
                                                       double poisson_ratio, const Method& method,
                                                       const SolidModel* before, Control& control);

}  // namespace elastolab
