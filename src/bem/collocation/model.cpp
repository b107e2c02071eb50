#include "bem/collocation/model.hpp"

#include "base/error.hpp"
#include "bem/boundary_field.hpp"
#include "bem/collocation/compliance_columns.hpp"
#include "bem/collocation/cost.hpp"
#include "bem/collocation/mixed_solver.hpp"
#include "bem/galerkin/error_estimate.hpp"
#include "bem/galerkin/surfaces.hpp"
#include "bem/given_loads.hpp"
#include "deform/reduced_solver.hpp"

namespace elastolab {

namespace {

bool same_system(const Method& a, const Method& b, BemSystem::Storage storage) {
    if (a.kind != b.kind || integral_tolerance(a) != integral_tolerance(b)) return false;
    return storage == BemSystem::Storage::hierarchical ||
           (a.mode == b.mode && a.column_memory == b.column_memory && factorises_ahead(a) == factorises_ahead(b));
}

}  // namespace

BemModel::BemModel(const BoundaryElement& element, const SurfaceMesh& surface, double poisson_ratio,
                   const Method& method, BemSystem::Storage storage, const BemModel* before, Control& control)
    : element_(element), method_(method), storage_(storage), poisson_ratio_(poisson_ratio) {
    if (before != nullptr && before->poisson_ratio_ == poisson_ratio && before->storage_ == storage &&
        same_system(before->method_, method, storage)) {
        system_ = before->system_;
    } else {
        auto boundary =
            before != nullptr ? before->system_->shared_boundary() : std::make_shared<const Boundary>(surface);
        system_ = std::make_shared<const BemSystem>(element, std::move(boundary), poisson_ratio, method, storage,
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
    facts_.findings = system_->findings();
    display_ = element_.display(mesh, system_->triangles_of_vertex());
}

std::unique_ptr<NodeSolver> BemModel::make_solver(const TractionSpace& space, const std::vector<int>& nodes,
                                                  int n_fixed, std::span<const UnitLoad> loads,
                                                  Control& control) const {
    if (system_->hierarchical())
        return std::make_unique<CollocationSolver>(system_->hierarchical(), space, nodes, loads,
                                                   method_.update == Update::direct, control);
    switch (method_.update) {
        case Update::direct:
            if (has_K())
                return std::make_unique<DirectSolver>(system_->operators(), nodes,
                                                      system_->given_tractions(loads, control), &control);
            return std::make_unique<MixedSolver>(*system_, space, nodes, n_fixed, loads, control);
        case Update::eqn9:
            if (has_K())
                return make_paper_solver(system_->operators(), nodes, system_->given_tractions(loads, control),
                                         control);
            if (2 * std::ssize(nodes) >= system_->n_nodes())
                return std::make_unique<MixedSolver>(*system_, space, nodes, n_fixed, loads, control);
            return std::make_unique<BoundaryEqn9Solver>(*system_, space, nodes, n_fixed, loads, control);
        case Update::reduced:
            break;
    }
    return std::make_unique<ReducedSolver>(reduced_system(system_, space, nodes, loads, control), control);
}

bool BemModel::has_K() const { return system_->operators() && element_.has_stiffness(method_.tractions); }

BemConstraints BemModel::constraints_of(std::span<const int> fixed, std::span<const int> handles) const {
    return element_.constrain(system_->boundary(), system_->triangles_of_vertex(), method_.tractions, fixed, handles);
}

std::uint64_t BemModel::constrain_memory(std::span<const int> fixed, std::span<const int> handles) const {
    const BemConstraints setting = constraints_of(fixed, handles);
    if (system_->hierarchical())
        return collocation_set_memory(facts_.n_vertices,
                                      facts_.n_vertices + 3 * std::ssize(setting.space.interior_triangles),
                                      setting.space.n_slots());
    if (method_.update == Update::reduced) return compliance_memory(*system_, setting.space);
    const auto all = 3 * static_cast<std::uint64_t>(system_->n_nodes());
    const auto constrained = 3 * static_cast<std::uint64_t>(setting.nodes.nodes.size()), free = all - constrained;
    const bool inverts = method_.update == Update::eqn9 && 2 * constrained < all;
    if (has_K()) return 8 * free * (inverts ? 2 * free + constrained : all);
    return mixed_memory(*system_, setting.space, static_cast<int>(setting.nodes.nodes.size()), setting.n_fixed) +
           (inverts ? 16 * free * free : 0);
}

std::unique_ptr<ConstrainedSolid> BemModel::constrain(std::span<const int> fixed, std::span<const int> handles,
                                                      std::span<const UnitLoad> loads, Control& control) const {
    // The single layer of a pressure on a closed cavity vanishes there, and the double layer has a solution without it.
    if (!loads.empty() && poisson_ratio_ == 0.5 && ClosedSurfaces(system_->boundary().mesh()).size() > 1)
        throw SolveError(
            "loads: collocation cannot tell how a body with a cavity answers them at Poisson's ratio 1/2. Choose "
            "galerkin-bem, or a smaller ratio.");
    BemConstraints setting = constraints_of(fixed, handles);
    const TractionSpace& space = setting.space;
    ParticularField particular = particular_field(system_->boundary().mesh(), poisson_ratio_,
                                                  system_->nodes().positions(Eigen::all, setting.nodes.nodes), loads);
    // With a body force it is u that rests at the fixed set: the rest of it, which is solved for, does not.
    if (!particular.empty()) setting.n_fixed = 0;
    std::unique_ptr<NodeSolver> solver = make_solver(space, setting.nodes.nodes, setting.n_fixed, loads, control);
    SolutionChecks its_checks = checks(space, joined(fixed, handles), loads);
    return std::make_unique<ConstrainedSolid>(facts_.n_vertices, std::move(setting.nodes), space.shares, display_,
                                              std::move(solver), std::move(its_checks), static_cast<int>(loads.size()),
                                              std::move(particular));
}

SolutionChecks BemModel::checks(const TractionSpace& space, std::vector<int> vertices,
                                std::span<const UnitLoad> given) const {
    SolutionChecks checks;
    const std::vector<UnitLoad> loads(given.begin(), given.end());
    checks.residual = [system = system_, space, loads](const NodeSolution& solution, Control& control) {
        return boundary_residual(*system, space, loads, solution, control);
    };
    checks.interior_field = [boundary = system_->shared_boundary(), display = display_, nu = poisson_ratio_,
                             elements = space.elements, loads](NodeSolution&& solution, Control&) {
        SurfaceTractions tractions(solution.displacements.cols());
        tractions.add(elements, solution.loads.topRows(3 * elements.n_slots));
        add_given(*boundary, loads, solution.factors, tractions);
        Eigen::MatrixXd u =
            display ? Eigen::MatrixXd(*display * solution.displacements) : std::move(solution.displacements);
        return with_body_forces(std::make_shared<const BoundaryField>(boundary, nu, std::move(u), std::move(tractions)),
                                boundary->mesh(), nu, loads, solution.factors);
    };
    checks.reference = [boundary = system_->shared_boundary(), method = method_, nu = poisson_ratio_,
                        vertices = std::move(vertices),
                        loads](const Eigen::VectorXd& values, const NodeSolution& first, Control& control) {
        return galerkin_reference(boundary->mesh(), method, nu, vertices, loads, values, first.displacements.col(0),
                                  control);
    };
    return checks;
}

std::uint64_t BemModel::check_memory(std::span<const int> fixed, std::span<const int> handles) const {
    return galerkin_reference_memory(system_->shared_boundary()->mesh(), method_, joined(fixed, handles));
}

void BemModel::visit_matrices(const std::function<void(const NamedMatrix&)>& visit) const {
    const auto operators = system_->operators();
    if (!operators) return;
    visit({"H", *system_->double_layer_matrix()});
    visit({"G", *system_->single_layer_matrix(), {kTractionCompliance}});
    visit({"K", operators->K, {kTractionStiffness}});
    visit({"Kinv", operators->D(), {kTractionCompliance}});
    // Inverse of [H B; B^T 0], with G multiplied into both blocks on the left, which act on tractions.
    visit(
        {"Khatinv",
         operators->Khatinv,
         {.nodes = kTractionCompliance, .has_border = true, .columns = {}, .rows = kTractionCompliance, .corner = {}}});
}

}  // namespace elastolab
