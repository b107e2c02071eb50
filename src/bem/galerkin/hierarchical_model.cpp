#include "bem/galerkin/hierarchical_model.hpp"

#include <algorithm>

#include "bem/galerkin/cost.hpp"
#include "bem/galerkin/error_estimate.hpp"
#include "bem/galerkin/field.hpp"
#include "bem/galerkin/residual.hpp"
#include "bem/given_loads.hpp"

namespace elastolab {

HierarchicalGalerkinModel::HierarchicalGalerkinModel(const SurfaceMesh& surface, double poisson_ratio,
                                                     const Method& method, const HierarchicalGalerkinModel* before,
                                                     Control& control)
    : method_(method),
      surface_(before != nullptr ? before->surface_ : std::make_shared<const SurfaceMesh>(surface)),
      poisson_ratio_(poisson_ratio) {
    facts_.n_vertices = surface.n_vertices();
    facts_.n_triangles = surface.n_triangles();
    facts_.n_degrees_of_freedom = 3 * surface.n_vertices();
    if (method.rims > 0) return;
    if (before != nullptr && before->system_ && before->poisson_ratio_ == poisson_ratio &&
        integral_tolerance(before->method_) == integral_tolerance(method))
        system_ = before->system_;
    else
        system_ = std::make_shared<const HierarchicalSystem>(surface, poisson_ratio, method, facts_.stages, control);
    facts_.memory_bytes = system_->memory_bytes();
}

std::unique_ptr<ConstrainedSolid> HierarchicalGalerkinModel::constrain(std::span<const int> fixed,
                                                                       std::span<const int> handles,
                                                                       std::span<const UnitLoad> loads,
                                                                       Control& control) const {
    const SurfaceSet given(*surface_, joined(fixed, handles), loads);
    if (method_.rims == 0) return constrain(system_, given, given, control);
    const FinerRims rims(*surface_, given.vertices, loads, method_.rims, LoneVertices::kept);
    StageTimes stages;
    return constrain(
        std::make_shared<const HierarchicalSystem>(rims.surface.mesh, poisson_ratio_, method_, stages, control), rims,
        given, control);
}

std::unique_ptr<ConstrainedSolid> HierarchicalGalerkinModel::constrain(std::shared_ptr<const HierarchicalSystem> system,
                                                                       const SurfaceSet& set, const SurfaceSet& of_body,
                                                                       Control& control) const {
    const auto& [vertices, loads, nodes, shares] = set;
    const SurfaceMesh& mesh = system->boundary().mesh();
    const GalerkinTractions tractions(mesh, system->surfaces(), vertices);
    auto solver = std::make_unique<HierarchicalSolver>(system, vertices, tractions, loads,
                                                       method_.update == Update::direct, control);
    const auto residual = [system, tractions, vertices = vertices, loads = loads](const NodeSolution& solution,
                                                                                  Control& its_control) {
        const GalerkinEquations equations{system->pairs(), system->tree(), system->surfaces(), system->material()};
        GivenTerms given;
        if (!loads.empty())
            given.nodal_forces = system->given_nodal_forces(loads, its_control) * solution.factors.col(0);
        if (!loads.empty() && tractions.size() > 0)
            given.single_layer = system->given_single_layer(tractions, loads, its_control) * solution.factors.col(0);
        return galerkin_residual(equations, vertices, tractions, given, solution, its_control);
    };
    const auto reference = [surface = surface_, method = method_, nu = poisson_ratio_, vertices = of_body.vertices,
                            loads = of_body.loads](const Eigen::VectorXd& values, const NodeSolution& first,
                                                   Control& its_control) {
        return galerkin_self_reference(*surface, method, nu, vertices, loads, values, first.displacements.col(0),
                                       its_control);
    };
    const auto inside = [boundary = std::shared_ptr<const Boundary>(system, &system->boundary()), tractions,
                         vertices = vertices, loads = loads, nu = poisson_ratio_](NodeSolution&& solution, Control&) {
        return galerkin_field(boundary, nu, vertices, tractions, loads, std::move(solution));
    };
    return std::make_unique<ConstrainedSolid>(
        facts_.n_vertices, nodes, shares, nullptr, std::move(solver), SolutionChecks{residual, reference, inside},
        static_cast<int>(loads.size()),
        particular_field(mesh, poisson_ratio_, mesh.vertices(Eigen::all, vertices), loads));
}

std::uint64_t HierarchicalGalerkinModel::constrain_memory(std::span<const int> fixed,
                                                          std::span<const int> handles) const {
    const std::vector<int> vertices = joined(fixed, handles);
    if (method_.rims > 0) {
        const FinerRims rims(*surface_, vertices, {}, method_.rims, LoneVertices::kept);
        const SurfaceMesh& fine = rims.surface.mesh;
        return hierarchical_memory(fine) + hierarchical_set_memory(fine.n_vertices(), rims.n_constrained_triangles,
                                                                   3 * rims.n_constrained_triangles);
    }
    const GalerkinTractions tractions(*surface_, system_->surfaces(), vertices);
    return hierarchical_set_memory(facts_.n_vertices, tractions.n_loaded(system_->surfaces()), tractions.size());
}

std::uint64_t HierarchicalGalerkinModel::check_memory(std::span<const int> fixed, std::span<const int> handles) const {
    const std::vector<int> vertices = joined(fixed, handles);
    const ClosedSurfaces surfaces(*surface_);
    const GalerkinTractions tractions(*surface_, surfaces, vertices);
    const std::int64_t n_loaded = tractions.n_loaded(surfaces);
    const std::uint64_t halved = galerkin_halved_memory(*surface_, method_, vertices);
    if (method_.rims == 0)
        return std::max({halved, galerkin_reference_memory(*surface_, method_, vertices),
                         galerkin_residual_memory(*surface_, n_loaded)});
    const FinerRims rims(*surface_, vertices, {}, method_.rims, LoneVertices::kept);
    return std::max({halved, galerkin_answer_memory(*surface_, method_, n_loaded, tractions.size()),
                     galerkin_residual_memory(rims.surface.mesh, n_loaded + rims.n_constrained_triangles)});
}

}  // namespace elastolab
