#include "bem/galerkin/hierarchical_model.hpp"

#include <algorithm>

#include "bem/galerkin/cost.hpp"
#include "bem/galerkin/error_estimate.hpp"
#include "bem/galerkin/field.hpp"
#include "bem/galerkin/given_loads.hpp"
#include "bem/galerkin/residual.hpp"
#include "bem/given_loads.hpp"

namespace elastolab {

HierarchicalGalerkinModel::HierarchicalGalerkinModel(const SurfaceMesh& surface, double poisson_ratio,
                                                     const Method& method, const HierarchicalGalerkinModel* before,
                                                     Control& control)
    : method_(method) {
    if (before != nullptr && before->system_->material().poisson_ratio == poisson_ratio &&
        integral_tolerance(before->method_) == integral_tolerance(method))
        system_ = before->system_;
    else
        system_ = std::make_shared<const HierarchicalSystem>(surface, poisson_ratio, method, facts_.stages, control);
    facts_.n_vertices = surface.n_vertices();
    facts_.n_triangles = surface.n_triangles();
    facts_.n_degrees_of_freedom = static_cast<int>(system_->size());
    facts_.memory_bytes = system_->memory_bytes();
}

std::unique_ptr<ConstrainedSolid> HierarchicalGalerkinModel::constrain(std::span<const int> fixed,
                                                                       std::span<const int> handles,
                                                                       std::span<const UnitLoad> unit_loads,
                                                                       Control& control) const {
    const std::vector<int> vertices = joined(fixed, handles);
    const std::vector<UnitLoad> loads(unit_loads.begin(), unit_loads.end());
    const SurfaceMesh& mesh = system_->boundary().mesh();
    const double nu = system_->material().poisson_ratio;
    const GalerkinTractions tractions(mesh, system_->surfaces(), vertices);
    auto solver = std::make_unique<HierarchicalSolver>(system_, vertices, tractions, loads,
                                                       method_.update == Update::direct, control);
    const auto residual = [system = system_, vertices, tractions, loads](const NodeSolution& solution,
                                                                         Control& its_control) {
        const GalerkinEquations equations{system->pairs(), system->tree(), system->surfaces(), system->material()};
        GivenTerms given;
        if (!loads.empty())
            given = {to_item_order(*system->tree(), system->given_nodal_forces(loads, its_control)) *
                         solution.factors.col(0),
                     given_single_layer(system->pairs(), system->surfaces(), tractions, system->material(), loads,
                                        its_control) *
                         solution.factors.col(0)};
        return galerkin_residual(equations, vertices, tractions, given, solution, its_control);
    };
    const auto reference = [system = system_, method = method_, nu, vertices, loads](
                               const Eigen::VectorXd& values, const NodeSolution&, Control& its_control) {
        return galerkin_self_reference(system->boundary().mesh(), method, nu, vertices, loads, values, its_control);
    };
    const auto inside = [boundary = std::shared_ptr<const Boundary>(system_, &system_->boundary()), vertices, tractions,
                         loads, nu](NodeSolution&& solution, Control&) {
        return galerkin_field(boundary, nu, vertices, tractions, loads, std::move(solution));
    };
    return std::make_unique<ConstrainedSolid>(
        facts_.n_vertices, constrain_vertices(vertices), nodal_shares(mesh.vertices, vertices), nullptr,
        std::move(solver), SolutionChecks{residual, reference, inside}, static_cast<int>(loads.size()),
        particular_field(mesh, nu, mesh.vertices(Eigen::all, vertices), loads));
}

std::uint64_t HierarchicalGalerkinModel::constrain_memory(std::span<const int> fixed,
                                                          std::span<const int> handles) const {
    const std::vector<int> vertices = joined(fixed, handles);
    const GalerkinTractions tractions(system_->boundary().mesh(), system_->surfaces(), vertices);
    return hierarchical_set_memory(facts_.n_vertices, tractions.n_loaded(system_->surfaces()), tractions.size());
}

std::uint64_t HierarchicalGalerkinModel::check_memory(std::span<const int> fixed, std::span<const int> handles) const {
    const std::vector<int> vertices = joined(fixed, handles);
    const GalerkinTractions tractions(system_->boundary().mesh(), system_->surfaces(), vertices);
    return std::max(galerkin_reference_memory(system_->boundary().mesh(), method_, vertices),
                    galerkin_residual_memory(system_->boundary().mesh(), tractions.n_loaded(system_->surfaces())));
}

}  // namespace elastolab
