#include "petsc/method.hpp"

#include <array>

#include "fem/method.hpp"
#include "fem/quadratic/method.hpp"
#include "mesh/tets/node_estimate.hpp"
#include "petsc/model.hpp"
#include "petsc/session.hpp"

namespace elastolab {

namespace {

constexpr std::array kPetscModes = {Mode::on_demand};
constexpr std::array kPetscUpdates = {Update::direct, Update::reduced};

template <ElementDegree degree>
std::shared_ptr<const SolidModel> precompute_petsc(const SurfaceMesh& surface, const std::string& name,
                                                   double poisson_ratio, const Method& method, const SolidModel* before,
                                                   Control& control) {
    if (const auto* same = dynamic_cast<const PetscFemModel*>(before);
        same != nullptr && same->degree() == degree && same->poisson_ratio() == poisson_ratio)
        return std::make_shared<PetscFemModel>(*same, method);
    return std::make_shared<PetscFemModel>(surface, name, poisson_ratio, method, control, degree);
}

/// On the first process's machine: the mesh, some vectors, and the matrices of all processes there. What is solved by
/// follows that.
template <ElementDegree degree>
Cost predict_petsc(const SurfaceMesh& surface, const Method&) {
    constexpr double kMeshAndVectors = 900.0, kMatrices = degree == ElementDegree::linear ? 10000.0 : 20000.0;
    const double nodes = estimated_tet_nodes(surface) * (degree == ElementDegree::linear ? 1.0 : 8.0);
    const double share = Session::current().part_on_this_machine();
    return {static_cast<std::int64_t>(3.0 * nodes),
            static_cast<std::uint64_t>(nodes * (kMeshAndVectors + kMatrices * share) + 2e7), 0.0};
}

template <ElementDegree degree>
MethodTraits distributed_traits(const MethodTraits& method) {
    MethodTraits traits = method;
    traits.modes = kPetscModes;
    traits.updates = kPetscUpdates;
    traits.precompute = precompute_petsc<degree>;
    traits.predict = predict_petsc<degree>;
    return traits;
}

}  // namespace

MethodKind distributed(MethodKind kind) {
    static const MethodTraits linear = distributed_traits<ElementDegree::linear>(*kFem);
    static const MethodTraits quadratic = distributed_traits<ElementDegree::quadratic>(*kQuadraticFem);
    if (kind == kFem) return &linear;
    return kind == kQuadraticFem ? &quadratic : nullptr;
}

}  // namespace elastolab
