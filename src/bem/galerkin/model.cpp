#include "bem/galerkin/model.hpp"

#include <algorithm>

#include "base/memory.hpp"
#include "bem/galerkin/error_estimate.hpp"
#include "bem/galerkin/field.hpp"
#include "bem/galerkin/residual.hpp"
#include "bem/galerkin/solvers.hpp"
#include "bem/given_loads.hpp"
#include "deform/holds.hpp"

namespace elastolab {

namespace {

/// Bytes of D's integrals above which another Poisson's ratio integrates anew: 1900 vertices.
constexpr std::uint64_t kMostKeptIntegrals = 512u << 20;

bool same_integrals(const Method& a, const Method& b) { return integral_tolerance(a) == integral_tolerance(b); }

bool same_galerkin_system(const Method& a, const Method& b) {
    return a.mode == b.mode && same_integrals(a, b) && a.column_memory == b.column_memory &&
           factorises_ahead(a) == factorises_ahead(b) && (a.rims > 0) == (b.rims > 0);
}

/// D's integrals for every Poisson's ratio: those at hand or, when the ratio changes for the first time, made now (for
/// little more than those of one ratio), so that further changes integrate nothing.
std::shared_ptr<const HypersingularParts> parts_for_change(const GalerkinSystem& before, const Method& method,
                                                           StageTimes& stages, Control& control) {
    const auto n = static_cast<std::uint64_t>(before.size());
    const std::uint64_t bytes = 16 * n * n;
    if (before.parts() || !factorises_ahead(method) || bytes > kMostKeptIntegrals ||
        3 * bytes > available_memory_bytes())  // with the new system beside the old one
        return before.parts();
    const Stage stage("integrate", control, stages);
    return std::make_shared<const HypersingularParts>(before.boundary(), integral_tolerance(method), control);
}

}  // namespace

GalerkinModel::GalerkinModel(const SurfaceMesh& surface, double poisson_ratio, const Method& method,
                             const GalerkinModel* before, Control& control)
    : method_(method), poisson_ratio_(poisson_ratio) {
    if (before != nullptr && before->poisson_ratio_ == poisson_ratio && same_galerkin_system(before->method_, method)) {
        system_ = before->system_;
    } else {
        auto boundary =
            before != nullptr ? before->system_->shared_boundary() : std::make_shared<const Boundary>(surface);
        std::shared_ptr<const HypersingularParts> parts;
        if (before != nullptr && same_integrals(before->method_, method)) {
            parts = before->poisson_ratio_ == poisson_ratio
                        ? before->system_->parts()
                        : parts_for_change(*before->system_, method, facts_.stages, control);
        }
        system_ = std::make_shared<const GalerkinSystem>(std::move(boundary), poisson_ratio, method, std::move(parts),
                                                         facts_.stages, control);
    }
    facts_.n_vertices = surface.n_vertices();
    facts_.n_triangles = surface.n_triangles();
    facts_.n_degrees_of_freedom = static_cast<int>(system_->size());
    facts_.memory_bytes = system_->memory_bytes();
    if (const auto reciprocal = system_->reciprocal_condition()) facts_.condition_estimate = 1.0 / *reciprocal;
}

std::unique_ptr<ConstrainedSolid> GalerkinModel::constrain(std::span<const int> fixed, std::span<const int> handles,
                                                           std::span<const UnitLoad> loads, Control& control) const {
    const SurfaceMesh& mesh = system_->boundary().mesh();
    const SurfaceSet given(mesh, joined(fixed, handles), loads);
    const bool is_direct = method_.update == Update::direct, is_held = holds(mesh.vertices, given.vertices);
    if (is_direct && !is_held) throw NotHeldError();
    if (method_.rims == 0) {
        const bool may_be_alone = is_held && !handles.empty();
        if (auto alone = may_be_alone ? first_set(given, control) : nullptr) return alone;
        std::optional<Eigen::MatrixXd> D;
        if (is_direct) {
            control.begin_stage("integrate");
            D = system_->hypersingular(control);
        }
        return constrain(system_, std::move(D), given, given, control);
    }
    if (is_held) {
        try {
            return constrain_with_finer_rims(given, control);
        } catch (const NotHeldError&) {
            if (is_direct) throw;
        }
    }
    // What moves least is found from compliance columns, which are those of the surface as given.
    StageTimes stages;
    Method method = method_;
    method.rims = 0;
    const auto system = std::make_shared<const GalerkinSystem>(system_->shared_boundary(), poisson_ratio_, method,
                                                               system_->parts(), stages, control);
    return constrain(system, std::nullopt, given, given, control);
}

std::unique_ptr<ConstrainedSolid> GalerkinModel::first_set(const SurfaceSet& given, Control& control) const {
    const GalerkinTractions tractions(system_->boundary().mesh(), system_->surfaces(), given.vertices);
    if (!is_sooner_alone(system_->size(), 3 * std::ssize(given.vertices), tractions.size())) return nullptr;
    std::unique_ptr<NodeSolver> solver;
    try {
        system_->solve_first_set(
            [&](const Eigen::MatrixXd& D) {
                solver = std::make_unique<GalerkinDirectSolver>(*system_, D, given.vertices, tractions, given.loads,
                                                                control);
            },
            control);
    } catch (const NotHeldError&) {
        return nullptr;  // compliance columns tell what moves least
    }
    return solver ? constrained(system_, std::move(solver), tractions, given, given) : nullptr;
}

HierarchicalGalerkinModel GalerkinModel::for_large_sets() const {
    Control control;
    return {system_->boundary().mesh(), poisson_ratio_, method_, nullptr, control};
}

std::unique_ptr<ConstrainedSolid> GalerkinModel::constrain_with_finer_rims(const SurfaceSet& given,
                                                                           Control& control) const {
    const FinerRims rims(system_->boundary().mesh(), given.vertices, given.loads, method_.rims, LoneVertices::kept);
    if (is_large(rims)) return for_large_sets().constrain(given.vertices, {}, given.loads, control);
    const Method direct{
        .kind = method_.kind, .update = Update::direct, .integral_tolerance = method_.integral_tolerance};
    StageTimes stages;
    const auto system = std::make_shared<const GalerkinSystem>(std::make_shared<const Boundary>(rims.surface.mesh),
                                                               poisson_ratio_, direct, nullptr, stages, control);
    control.begin_stage("integrate");
    return constrain(system, system->hypersingular(*system_, rims.surface, control), rims, given, control);
}

std::unique_ptr<ConstrainedSolid> GalerkinModel::constrain(std::shared_ptr<const GalerkinSystem> system,
                                                           std::optional<Eigen::MatrixXd> D, const SurfaceSet& set,
                                                           const SurfaceSet& of_body, Control& control) const {
    const GalerkinTractions tractions(system->boundary().mesh(), system->surfaces(), set.vertices);
    std::unique_ptr<NodeSolver> solver;
    if (D)
        solver = std::make_unique<GalerkinDirectSolver>(*system, *D, set.vertices, tractions, set.loads, control);
    else
        solver = std::make_unique<ReducedSolver>(
            galerkin_reduced_system(system, set.vertices, tractions, set.loads, control), control);
    return constrained(std::move(system), std::move(solver), tractions, set, of_body);
}

std::unique_ptr<ConstrainedSolid> GalerkinModel::constrained(std::shared_ptr<const GalerkinSystem> system,
                                                             std::unique_ptr<NodeSolver> solver,
                                                             const GalerkinTractions& tractions, const SurfaceSet& set,
                                                             const SurfaceSet& of_body) const {
    const auto& [vertices, loads, nodes, shares] = set;
    const SurfaceMesh& mesh = system->boundary().mesh();
    const auto residual = [system, vertices = vertices, loads = loads, tractions](const NodeSolution& solution,
                                                                                  Control& its_control) {
        const auto pairs = std::make_shared<const BoundaryPairs>(system->shared_boundary(), system->tolerance());
        const GalerkinEquations equations{pairs, pairs->cluster_vertices(kVerticesOfALeaf), system->surfaces(),
                                          system->material()};
        GivenTerms given;
        if (!loads.empty())
            given.nodal_forces = system->given_nodal_forces(loads, its_control) * solution.factors.col(0);
        if (!loads.empty() && tractions.size() > 0)
            given.single_layer = system->given_single_layer(tractions, loads, its_control) * solution.factors.col(0);
        return galerkin_residual(equations, vertices, tractions, given, solution, its_control);
    };
    const auto reference = [body = system_, method = method_, nu = poisson_ratio_, vertices = of_body.vertices,
                            loads = of_body.loads](const Eigen::VectorXd& values, const NodeSolution& first,
                                                   Control& its_control) {
        return galerkin_self_reference(body->boundary().mesh(), method, nu, vertices, loads, values,
                                       first.displacements.col(0), its_control);
    };
    const auto inside = [boundary = system->shared_boundary(), vertices = vertices, loads = loads, tractions,
                         nu = poisson_ratio_](NodeSolution&& solution, Control&) {
        return galerkin_field(boundary, nu, vertices, tractions, loads, std::move(solution));
    };
    return std::make_unique<ConstrainedSolid>(
        facts_.n_vertices, nodes, shares, nullptr, std::move(solver), SolutionChecks{residual, reference, inside},
        static_cast<int>(loads.size()),
        particular_field(mesh, poisson_ratio_, mesh.vertices(Eigen::all, vertices), loads));
}

std::uint64_t GalerkinModel::constrain_memory(std::span<const int> fixed, std::span<const int> handles) const {
    const std::vector<int> vertices = joined(fixed, handles);
    const SurfaceMesh& mesh = system_->boundary().mesh();
    if (method_.rims > 0) {
        const FinerRims rims(mesh, vertices, {}, method_.rims, LoneVertices::kept);
        if (is_large(rims)) return for_large_sets().constrain_memory(fixed, handles);
        return galerkin_direct_memory(3 * std::int64_t{rims.surface.mesh.n_vertices()},
                                      3 * rims.n_constrained_triangles);
    }
    const GalerkinTractions tractions(mesh, system_->surfaces(), vertices);
    const Eigen::Index n_loads = 3 * std::ssize(vertices);
    if (method_.update == Update::reduced) {
        const bool may_be_alone = !system_->is_factorised() && system_->serves_sets();
        const std::uint64_t columns = half_column_memory(*system_, n_loads + tractions.size());
        return may_be_alone ? std::max(columns, galerkin_direct_memory(system_->size(), tractions.size())) : columns;
    }
    return galerkin_direct_memory(system_->size(), tractions.size());
}

std::uint64_t GalerkinModel::check_memory(std::span<const int> fixed, std::span<const int> handles) const {
    const std::vector<int> vertices = joined(fixed, handles);
    const SurfaceMesh& mesh = system_->boundary().mesh();
    const GalerkinTractions tractions(mesh, system_->surfaces(), vertices);
    const std::int64_t n_loaded = tractions.n_loaded(system_->surfaces());
    const std::uint64_t halved = galerkin_halved_memory(mesh, method_, vertices);
    if (method_.rims == 0)
        return std::max(
            {halved, galerkin_reference_memory(mesh, method_, vertices), galerkin_residual_memory(mesh, n_loaded)});
    const FinerRims rims(mesh, vertices, {}, method_.rims, LoneVertices::kept);
    return std::max({halved, galerkin_direct_memory(system_->size(), tractions.size()),
                     galerkin_residual_memory(rims.surface.mesh, n_loaded + rims.n_constrained_triangles)});
}

void GalerkinModel::visit_matrices(const std::function<void(const NamedMatrix&)>& visit) const {
    const auto dense = system_->dense();
    if (!dense) return;
    visit({"D", dense->D, {kNodalStiffness}});
    visit({"Dplus", dense->pseudo_inverse, {kNodalCompliance}});
}

}  // namespace elastolab
