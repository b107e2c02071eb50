#include "scene/solve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Geometry>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"
#include "deform/grip_check.hpp"
#include "deform/grip_equilibrium.hpp"
#include "deform/load_work.hpp"
#include "deform/node_solver.hpp"
#include "deform/patch_reactions.hpp"
#include "findings/cost.hpp"
#include "findings/solution.hpp"
#include "findings/words.hpp"
#include "methods/precompute.hpp"
#include "scene/balance.hpp"
#include "scene/linear_theory.hpp"
#include "scene/proxy/carried_constraints.hpp"
#include "scene/scene_failure.hpp"
#include "scene/scene_mesh.hpp"
#include "scene/wish.hpp"

namespace elastolab {

namespace {

std::vector<GroupReaction> totals(const std::vector<ConstraintGroup>& groups, const Reactions& reactions) {
    std::vector<GroupReaction> result;
    for (const ConstraintGroup& group : groups) {
        const int n = group.end - group.begin;
        result.push_back({.name = group.name,
                          .force = reactions.forces.middleCols(group.begin, n).rowwise().sum(),
                          .moment = reactions.moments.middleCols(group.begin, n).rowwise().sum()});
        if (!result.back().force.allFinite() || !result.back().moment.allFinite())
            throw SolveError(shortened(group.name, 60) +
                             ": its total force is beyond double precision. Choose a smaller Young's modulus, or "
                             "smaller motions.");
    }
    return result;
}

/// Total force and moment of each load at its size, on the surface that is simulated: at rest, or of methods that are
/// not linear where it is by now.
std::vector<GroupReaction> load_totals(const Constraints& constraints, const SurfaceMesh& surface,
                                       const std::vector<Resultant>& present) {
    std::vector<GroupReaction> result;
    const Eigen::VectorXd factors = constraints.values.tail(std::ssize(constraints.set.loads));
    for (const AppliedLoad& load : constraints.loads) {
        result.push_back({load.name, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
        for (int i = load.first; i < load.first + load.count; ++i) {
            const auto at = static_cast<std::size_t>(i);
            const Resultant unit = present.empty() ? resultant(surface, constraints.set.loads[at]) : present[at];
            const double factor = present.empty() ? factors[i] : 1.0;
            result.back().force += factor * unit.force;
            result.back().moment += factor * unit.moment;
        }
    }
    return result;
}

/// From rest by the turns that the motions of these constraints take; surface: what the set is on.
Approach approach_to(const Constraints& constraints, const SurfaceMesh& surface) {
    const Positions rest = surface.vertices(Eigen::all, constraints.set.handles);
    return {nullptr, way_to(wish_of(constraints), nullptr, rest).path};
}

/// Handles under a force in equilibrium: the way to the answer, what was iterated for it, and the handles as grips.
struct PlacedHandles {
    Approach approach;
    int iterations = 0;
    GripsInPlace grips = {};
};

/// Moves the handles under a force to where they are in equilibrium: in the constraints of the simulated surface, and
/// in those of the shown one, if that is another.
PlacedHandles take_equilibrium(const Deformer& deformer, Constraints& constraints, Constraints* shown,
                               const Positions& vertices, Control& control) {
    const SurfaceMesh& surface = *deformer.model().body().surface;
    PlacedHandles placed{.approach = approach_to(constraints, surface)};
    if (!constraints.has_forces()) return placed;
    std::vector<AffineMotion> motions;
    if (deformer.linear()) {
        const GripStiffness stiffness(deformer, constraints.values, constraints.grips(), control);
        motions = constraints.move_grips(stiffness, surface.vertices);
        placed.grips = in_place(stiffness);
    } else {
        const GripEquilibrium found = find_grip_equilibrium(deformer, constraints.values, constraints.grips(),
                                                            constraints.grip_forces(), control, placed.approach);
        motions = constraints.move_grips(found.places, surface.vertices);
        placed.approach = {found.equilibrium, {}};
        placed.iterations = found.iterations;
        placed.grips = in_place(found);
    }
    const std::vector<std::size_t> handles = constraints.gripped();
    for (std::size_t g = 0; g < handles.size() && shown != nullptr; ++g) shown->move(handles[g], motions[g], vertices);
    return placed;
}

void append(Findings& all, const Findings& more) { all.insert(all.end(), more.begin(), more.end()); }

SceneMesh load_mesh(const SolveRequest& request, Solution& solution, Control& control) {
    const Stage stage("load", control, solution.stages);
    SceneMesh mesh = load_scene_mesh(request.document.mesh, request.scene_file, control);
    solution.mesh_name = mesh.name;
    if (request.document.camera) solution.vertical = request.document.camera->vertical;
    solution.defects = mesh.checked.report.defects;
    solution.surface = std::make_shared<const SurfaceMesh>(std::move(mesh.checked.mesh));
    return mesh;
}

/// What is simulated: the scene's surface, or a proxy.
Body make_body(const SolveRequest& request, const SceneMesh& mesh, Solution& solution, Control& control) {
    const Document& document = request.document;
    const MethodKind kind = request.method.kind;
    require_material(document.material, kind, request.scene_file);
    Body body{.name = mesh.name, .surface = solution.surface, .material = document.material};
    if (needs_proxy(document.proxy, mesh.checked.report, kind)) {
        const Stage stage("proxy", control, solution.stages);
        solution.proxy = make_proxy(mesh.name, solution.surface, mesh.checked.report, document.proxy, control);
        append(solution.findings, findings_of_proxy(*solution.proxy, mesh.name));
        body.surface = solution.proxy->surface;
    } else {
        require_usable(mesh, kind);
    }
    return body;
}

void precompute_model(const Method& method, const Body& body, Solution& solution, Control& control) {
    solution.predicted = predict_cost(*body.surface, method);
    solution.model = solution.model ? precompute_again(*solution.model, body.material, method, control)
                                    : precompute(body, method, control);
    const ModelFacts& facts = solution.model->facts();
    solution.stages.insert(solution.stages.end(), facts.stages.begin(), facts.stages.end());
    append(solution.findings, findings_of_model(*solution.model));
}

/// Forces below this fraction of Young's modulus times displacement times length are rounding.
constexpr double kRoundingForce = 1e-12;

/// Sizes of all forces, of loads and at constrained vertices, added up, and what rounding may make of none.
double all_forces(const Constraints& constraints, const Deformer::Answer& answer, const Body& body) {
    const SurfaceMesh& surface = *body.surface;
    const Reactions& reactions = answer.reactions;
    double sum = kRoundingForce * body.material.young_modulus * size_of(surface) *
                 answer.displacements.reshaped(3, surface.n_vertices()).colwise().stableNorm().maxCoeff();
    for (const auto& force : reactions.forces.colwise()) sum += force.stableNorm();
    const std::vector<UnitLoad>& loads = constraints.set.loads;
    return sum + gross_force(surface, loads, constraints.values.tail(std::ssize(loads)));
}

/// Share of the largest reaction above which an imbalance is reported.
constexpr double kLargeImbalance = 0.05;

void add_imbalance(const Imbalance& imbalance, MethodKind method, Findings& findings) {
    const auto add = [&](FindingKind kind, double value) {
        if (!(value > kLargeImbalance)) return;
        const Severity severity = method->balances_forces ? Severity::error : Severity::warning;
        findings.push_back({.kind = kind, .severity = severity, .value = value, .method = method});
    };
    add(FindingKind::force_imbalance, imbalance.force);
    add(FindingKind::moment_imbalance, imbalance.moment);
}

/// Applies the constraints and evaluates what follows from them. shown: those of the shown surface, where a proxy of it
/// is simulated.
void apply(Constraints& constraints, Constraints* shown, bool with_checks, Solution& solution, Control& control) {
    const auto kept = std::make_shared<Deformer>(solution.model);
    Deformer& deformer = *kept;
    solution.predicted.memory_bytes =
        std::max(solution.predicted.memory_bytes,
                 solution.model->facts().memory_bytes + deformer.predict_memory(constraints.set));
    {
        const Stage stage("constrain", control, solution.stages);
        deformer.constrain(constraints.set, control);
    }
    PlacedHandles placed;
    {
        const Stage stage("displace", control, solution.stages);
        placed = take_equilibrium(deformer, constraints, shown, solution.surface->vertices, control);
        const Deformer::Answer answer =
            deformer.answer(constraints.values, {.residual = with_checks}, control, placed.approach);
        solution.displacement =
            Eigen::Map<const Eigen::Matrix3Xd>(answer.displacements.data(), 3, answer.displacements.size() / 3);
        solution.simulated_displacement = answer.displacements;
        solution.constrained = constraints.set.fixed;
        solution.constrained.insert(solution.constrained.end(), constraints.set.handles.begin(),
                                    constraints.set.handles.end());
        solution.forces = answer.reactions.forces;
        solution.reactions = totals(constraints.groups, answer.reactions);
        std::vector<ConstraintGroup> fixed_sets = constraints.fixed_sets;
        std::erase_if(fixed_sets, [](const ConstraintGroup& set) { return set.begin == set.end; });
        solution.fixed_reactions = totals(fixed_sets, answer.reactions);
        solution.residual = answer.residual;
        solution.facts = answer.facts;
        if (solution.facts) solution.facts->iterations += placed.iterations;
        if (answer.facts && !answer.facts->stable)
            solution.findings.push_back(
                {.kind = FindingKind::unstable_equilibrium, .method = solution.model->method().kind});
        solution.loads = load_totals(constraints, *solution.model->body().surface, answer.loads);
        std::vector<GroupReaction> all = solution.reactions;
        all.insert(all.end(), solution.loads.begin(), solution.loads.end());
        if (!moves_rigidly(constraints, *solution.model->body().surface))
            solution.imbalance = imbalance_of(all, all_forces(constraints, answer, solution.model->body()),
                                              *solution.model->body().surface);
        if (!constraints.loads.empty())
            solution.compliance = answer.facts
                                      ? answer.facts->work_of_loads
                                      : work_of_loads(*solution.model, constraints.set, constraints.values, answer);
        add_imbalance(solution.imbalance, solution.model->method().kind, solution.findings);
    }
    if (with_checks) {
        const Stage stage("check", control, solution.stages);
        solution.predicted.memory_bytes += deformer.predict_check_memory(constraints.set);
        Deformer::Answer answer = deformer.answer(constraints.values, {.check = true}, control);
        correct_check(deformer, constraints.values, placed.grips, answer, control);
        if (answer.check) {
            solution.error_estimate = answer.check->relative_error;
            if (std::isfinite(answer.check->relative_force_error))
                solution.force_error_estimate = answer.check->relative_force_error;
        }
        append(solution.findings, findings_of_answer(deformer, answer));
    }
    solution.condition_estimate =
        std::max(solution.model->facts().condition_estimate, deformer.quality().condition_estimate);
    append(solution.findings, findings_of_set(deformer));
    solution.deformer = kept;
    solution.values = constraints.values;
    solution.groups = constraints.groups;
}

/// How far linear theory is off for this motion, on the surface itself where that is small, else on a coarse proxy.
/// The answer is there: where this fails, it is left out.
void gauge(const SceneMesh& mesh, const Constraints& shown, const Constraints& simulated, Solution& solution,
           Control& control) {
    const bool moves = simulated.has_forces() || !simulated.values.isZero(0.0) ||
                       approach_to(simulated, *solution.model->body().surface).path.cols() > 0;
    if (!moves || !solution.model->method().kind->linear || solution.model->parts().size() > kMostGaugedSolids) return;
    const Stage stage("linear theory", control, solution.stages);
    try {
        Body body = solution.model->body();
        std::optional<CarriedConstraints> carried;
        const Constraints* constraints = &simulated;
        if (body.surface->n_vertices() > kMostGaugedThemselves) {
            const std::shared_ptr<const Proxy> coarse =
                solution.proxy ? make_coarser_proxy(mesh.name, *solution.proxy, kGaugeVertices, control)
                               : make_proxies(mesh.name, solution.surface, mesh.checked.report,
                                              std::array{kGaugeVertices}, control)
                                     .front();
            carried.emplace(coarse).set(shown);
            constraints = &carried->constraints();
            body.surface = coarse->surface;
        }
        const double moved = solution.displacement.colwise().norm().maxCoeff();
        const HandleForces by_force =
            in_proportion({constraints->grips(), constraints->grip_forces()}, moved, *body.surface);
        const LinearTheoryGauge linear_theory(body, constraints->set, control);
        const std::optional<double> error =
            linear_theory.error(constraints->values, control, approach_to(*constraints, *body.surface), by_force);
        if (!error) return;
        if (std::isfinite(*error)) solution.linear_theory_error = error;
        append(solution.findings,
               findings_of_linear_theory(solution.model->method().kind, *error, body.material.poisson_ratio));
    } catch (const Error&) {
        return;
    }
}

/// On a proxy a handle may be left without a vertex, where others have those nearby: its force would act on nothing.
void require_vertices_for_forces(const SolveRequest& request, const Constraints& constraints) {
    for (std::size_t h = 0; h < request.document.handles.size(); ++h) {
        const auto [begin, end] = constraints.range_of(h);
        if (begin != end || !request.document.handles[h].force) continue;
        fail_at(
            request.scene_file, "/handles/" + std::to_string(h),
            "is smaller than the proxy's triangles, and others hold the vertices there, so that its force would act "
            "on nothing. Ask for more proxy vertices.");
    }
}

void carry_back(const CarriedConstraints& carried, Solution& solution) {
    const Eigen::VectorXd u = carried.displacement(solution.displacement.reshaped());
    solution.displacement = Eigen::Map<const Eigen::Matrix3Xd>(u.data(), 3, u.size() / 3);
    solution.findings = carried.as_shown(std::move(solution.findings));
}

}  // namespace

Imbalance imbalance_of(const std::vector<GroupReaction>& reactions, double all_forces, const SurfaceMesh& surface) {
    constexpr double kShareOfAll = 0.1;  // resultants that are smaller tell nothing of what they are made of
    const Eigen::Vector3d centre = surface.vertices.rowwise().mean();
    const double radius = (surface.vertices.colwise() - centre).colwise().norm().maxCoeff();
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = force;
    double largest_force = kShareOfAll * all_forces, largest_moment = radius * largest_force;
    for (const GroupReaction& reaction : reactions) {
        const Eigen::Vector3d about_centre = reaction.moment - centre.cross(reaction.force);
        force += reaction.force;
        moment += about_centre;
        largest_force = std::max(largest_force, reaction.force.stableNorm());
        largest_moment = std::max({largest_moment, about_centre.stableNorm(), radius * reaction.force.stableNorm()});
    }
    return {largest_force > 0.0 ? force.stableNorm() / largest_force : 0.0,
            largest_moment > 0.0 ? moment.stableNorm() / largest_moment : 0.0};
}

std::vector<std::string> Solution::warnings() const {
    std::vector<std::string> texts;
    for (const Defect& defect : defects) texts.push_back(mesh_name + ": " + defect.text);
    for (const Finding& finding : findings) texts.push_back(words(finding));
    return texts;
}

SolvedBody solved_body(const Solution& solution) {
    return {.shown = solution.surface,
            .proxy = solution.proxy,
            .deformer = solution.deformer,
            .values = solution.values,
            .displacement = solution.displacement.reshaped(),
            .simulated_displacement = solution.simulated_displacement,
            .constrained = solution.constrained,
            .forces = solution.forces};
}

Solution solve(const SolveRequest& request, Control& control) {
    Solution solution;
    const SceneMesh mesh = load_mesh(request, solution, control);
    const Body body = make_body(request, mesh, solution, control);
    Constraints shown = make_constraints(request.document, *solution.surface, request.scene_file);
    std::optional<CarriedConstraints> carried;
    if (solution.proxy) carried.emplace(solution.proxy).set(shown);
    Constraints constraints = carried ? carried->constraints() : shown;
    require_vertices_for_forces(request, constraints);
    require_balance(request.document, constraints, *body.surface, request.scene_file);
    solution.n_constrained = static_cast<int>(shown.set.fixed.size() + shown.set.handles.size());
    if (solution.n_constrained == 0 && shown.loads.empty())
        solution.findings.push_back({.kind = FindingKind::nothing_constrained, .object = request.scene_file.string()});
    const auto run = [&] {
        apply(constraints, carried ? &shown : nullptr, request.with_checks, solution, control);
        if (request.with_checks) gauge(mesh, shown, constraints, solution, control);
        if (!carried) return;
        carried->set(shown);  // where handles under a force have moved to
        carry_back(*carried, solution);
    };
    Method method = request.method;
    const auto solve_by = [&](Update update) {
        method.update = update;
        precompute_model(method, body, solution, control);
        run();
    };
    if (!request.solve_once) {
        solve_by(method.update);
        return solution;
    }
    const Findings known = solution.findings;
    try {
        solve_by(Update::direct);
    } catch (const NotHeldError&) {  // what it took is counted, what it found is found again
        solution.findings = known;
        solve_by(Update::reduced);
    }
    return solution;
}

}  // namespace elastolab
