#include "bem/model.hpp"

#include "base/error.hpp"
#include "bem/responses.hpp"
#include "bem/mixed_solver.hpp"
#include "bem/error_estimate.hpp"
#include "findings/guards.hpp"
#include "deform/reduced_solver.hpp"

namespace elastolab {

namespace {

bool same_system(const Method& a, const Method& b) {
    return a.kind == b.kind && a.mode == b.mode && a.integral_tolerance == b.integral_tolerance &&
           a.column_memory == b.column_memory && factorises_ahead(a) == factorises_ahead(b);
}

bool same_integrals(const Method& a, const Method& b) {
    return a.kind == b.kind && a.integral_tolerance == b.integral_tolerance;
}

ReducedSystem reduced_system(const std::shared_ptr<const BemSystem>& system, const LoadPlan& plan,
                             const std::vector<int>& nodes, Control& control) {
    ReducedSystem reduced;
    reduced.responses = std::make_shared<const BemResponses>(system, plan, control);
    reduced.rigid = system->rigid();
    reduced.nodes = nodes;
    reduced.n_loads = 3 * plan.n_slots();
    return reduced;
}

}  // namespace

BemModel::BemModel(const SurfaceMesh& surface, double poisson_ratio, const Method& method, Control& control)
    : method_(method), poisson_ratio_(poisson_ratio) {
    system_ = std::make_shared<const BemSystem>(std::make_shared<const Boundary>(surface), poisson_ratio, method,
                                                BemIntegrals{}, facts_.stages, control);
    note_facts();
}

BemModel::BemModel(const BemModel& before, double poisson_ratio, const Method& method, Control& control)
    : method_(method), poisson_ratio_(poisson_ratio) {
    if (same_system(before.method_, method) && before.poisson_ratio_ == poisson_ratio) {
        system_ = before.system_;
    } else {
        const auto integrals = same_integrals(before.method_, method) ? before.system_->integrals() : BemIntegrals{};
        system_ = std::make_shared<const BemSystem>(before.system_->shared_boundary(), poisson_ratio, method, integrals,
                                                    facts_.stages, control);
    }
    note_facts();
}

void BemModel::note_facts() {
    const SurfaceMesh& mesh = system_->boundary().mesh();
    facts_.n_vertices = mesh.n_vertices();
    facts_.n_triangles = mesh.n_triangles();
    facts_.n_degrees_of_freedom = 3 * system_->n_nodes();
    facts_.memory_bytes = system_->memory_bytes();
    facts_.condition_estimate = system_->condition();
    facts_.warnings = system_->warnings();
    for (const auto& more : {warn_of_surface(mesh, system_->is_constant()),
                             warn_of_condition("boundary-element matrix", system_->condition())})
        facts_.warnings.insert(facts_.warnings.end(), more.begin(), more.end());
    if (system_->is_constant())
        display_ = std::make_shared<const SparseRows>(average_of_triangles(mesh, system_->around()));
}

std::unique_ptr<NodeSolver> BemModel::make_solver(const LoadPlan& plan, const std::vector<int>& nodes, int n_base,
                                                  Control& control) const {
    switch (method_.update) {
        case Update::direct:
            if (has_K()) return std::make_unique<DirectSolver>(system_->operators(), nodes, &control);
            return std::make_unique<MixedSolver>(*system_, plan, nodes, n_base, control);
        case Update::eqn9:
            if (!system_->operators())
                throw SolveError("update eqn9: needs K and its inverse in memory. Choose the mode full.");
            if (has_K()) return make_paper_solver(system_->operators(), nodes, control);
            if (2 * std::ssize(nodes) >= system_->n_nodes())
                return std::make_unique<MixedSolver>(*system_, plan, nodes, n_base, control);
            return std::make_unique<BoundaryEqn9Solver>(*system_, plan, nodes, n_base, control);
        case Update::reduced:
            break;
    }
    return std::make_unique<ReducedSolver>(reduced_system(system_, plan, nodes, control), control);
}

bool BemModel::has_K() const {
    return system_->operators() && (system_->is_constant() || method_.tractions == Tractions::continuous);
}

BemModel::Setting BemModel::setting_of(std::span<const int> base, std::span<const int> handles) const {
    std::vector<int> vertices(base.begin(), base.end());
    vertices.insert(vertices.end(), handles.begin(), handles.end());
    const Boundary& boundary = system_->boundary();
    if (!system_->is_constant())
        return {constrain_vertices(vertices),
                plan_linear_loads(boundary, system_->around(), method_.tractions, vertices),
                static_cast<int>(base.size())};
    ConstrainedNodes nodes = constrain_triangles(boundary.mesh(), system_->around(), vertices);
    LoadPlan plan = plan_constant_loads(boundary, nodes.nodes, nodes.prescribe);
    // Constant elements mix base and handles in their triangles; none of those counts as resting then.
    return {std::move(nodes), std::move(plan), 0};
}

std::uint64_t BemModel::constrain_memory(std::span<const int> base, std::span<const int> handles) const {
    const Setting setting = setting_of(base, handles);
    if (method_.update == Update::reduced) return response_memory(*system_, setting.plan);
    const auto all = 3 * static_cast<std::uint64_t>(system_->n_nodes());
    const auto constrained = 3 * static_cast<std::uint64_t>(setting.nodes.nodes.size()), free = all - constrained;
    const bool inverts = method_.update == Update::eqn9 && 2 * constrained < all;
    if (has_K()) return 8 * free * (inverts ? 2 * free + constrained : all);
    return mixed_memory(*system_, setting.plan, static_cast<int>(setting.nodes.nodes.size()), setting.n_base) +
           (inverts ? 16 * free * free : 0);
}

std::unique_ptr<ConstrainedSolid> BemModel::constrain(std::span<const int> base, std::span<const int> handles,
                                                      Control& control) const {
    Setting setting = setting_of(base, handles);
    const LoadPlan& plan = setting.plan;
    std::unique_ptr<NodeSolver> solver = make_solver(plan, setting.nodes.nodes, setting.n_base, control);
    SolutionChecks its_checks = checks(plan, setting.nodes.nodes);
    return std::make_unique<ConstrainedSolid>(facts_.n_vertices, std::move(setting.nodes), plan.shares, display_,
                                              std::move(solver), std::move(its_checks));
}

SolutionChecks BemModel::checks(const LoadPlan& plan, const std::vector<int>& nodes) const {
    SolutionChecks checks;
    checks.residual = [system = system_, plan](const NodeSolution& solution, Control& control) {
        return boundary_residual(*system, plan, solution, control);
    };
    if (system_->is_constant()) {
        checks.error = [system = system_, display = display_](const NodeSolver&, const NodeSolution& solution,
                                                              Control&) {
            return spread_around_vertices(*system, *display, solution);
        };
        return checks;
    }
    checks.error = [system = system_, plan, nodes](const NodeSolver& solver, const NodeSolution& solution,
                                                   Control& control) -> Eigen::VectorXd {
        const Eigen::VectorXd residual = -residual_between_nodes(*system, plan, solution, control);
        Eigen::VectorXd error = solver.response_to_residual(residual, control);
        if (error.size() > 0) return error;
        return ReducedSolver(reduced_system(system, plan, nodes, control), control)  // Eqns. 7 and 9 on K
            .response_to_residual(residual, control);
    };
    return checks;
}

void BemModel::visit_matrices(const std::function<void(const NamedMatrix&)>& visit) const {
    const auto operators = system_->operators();
    if (!operators) return;
    visit({"H", *system_->double_layer_matrix()});
    visit({"G", *system_->single_layer_matrix()});
    visit({"K", operators->K});
    visit({"Kinv", operators->D()});
    visit({"Khatinv", operators->Khatinv});
}

}  // namespace elastolab
