#include "bem/galerkin/error_estimate.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/memory.hpp"
#include "bem/cost.hpp"
#include "bem/galerkin/cost.hpp"
#include "bem/galerkin/finer_rims.hpp"
#include "bem/galerkin/hierarchical_system.hpp"
#include "bem/galerkin/method.hpp"
#include "bem/galerkin/solvers.hpp"
#include "bem/given_loads.hpp"
#include "deform/holds.hpp"
#include "deform/pinned_body.hpp"
#include "mesh/topology.hpp"
#include "mesh/triangles_across.hpp"

namespace elastolab {

namespace {

/// Relative tolerance of the integrals: far stricter than an estimate needs.
constexpr double kReferenceTolerance = 1e-6;
/// Vertices above which the reference would take many minutes.
constexpr int kMostVertices = 20000;
/// It may take this many times as long as the answer, or this many seconds, which nobody minds for an error: small
/// bodies with slivers are answered in a twentieth of a second, and can be wrong by a third.
constexpr double kMostTimes = 10.0, kAlwaysSeconds = 2.0;
/// Error of Galerkin BEM over what a row along the rims changes, which leaves a quarter of the error.
/// tests/methods/discretisation_test.cpp and organic_loads_test.cpp measure it.
constexpr double kShareOfRims = 1.3;
/// Error of Galerkin BEM with 1, 2 or 3 rows along the rims over what these rows change. Most of it is elsewhere, which
/// these rows cannot show: rather too much is told. tests/methods/discretisation_test.cpp measures it.
constexpr std::array<double, kMostRims> kShareLeft = {0.55, 0.45, 0.40};

/// Error of Galerkin BEM on a surface of few triangles across over what halving all of them changes: a row along the
/// rims shows a fifth of it. tests/scene/grip_estimate_test.cpp measures it.
constexpr double kShareOfHalving = 1.15;

/// Error of Galerkin BEM over what a row along the rims changes where a whole closed surface bears a load: most of it
/// is there, and no rim. tests/scene/grip_estimate_test.cpp measures it.
constexpr double kShareOfRimsUnderLoads = 2.6;

/// Of which the second answer is, beside an answer by that method.
Method reference_method(const Method& answer) {
    return {.kind = kGalerkinBem,
            .update = Update::direct,
            .hierarchical_from = answer.hierarchical_from,
            .integral_tolerance = kReferenceTolerance};
}

std::int64_t count_triangles(const SurfaceMesh& surface, std::span<const UnitLoad> loads) {
    std::int64_t n = 0;
    for (const UnitLoad& load : loads) {
        if (load.is_body_force()) return surface.n_triangles();
        n += std::ssize(load.triangles);
    }
    return std::min<std::int64_t>(n, surface.n_triangles());
}

/// Seconds of one answer on a surface, all that is computed for it, on a usual machine: whether an error is told must
/// not depend on what else runs. Of Galerkin BEM with dense matrices the set and the loads are known; what the other
/// methods take depends on them less.
double predicted_seconds(const SurfaceMesh& surface, Method method, std::int64_t n_constrained,
                         std::span<const UnitLoad> loads) {
    method.update = Update::reduced;  // which factorises what the others do for each set
    if (method.kind == kGalerkinBem && !is_hierarchical(surface, method))
        return predict_galerkin_answer(surface, n_constrained, count_triangles(surface, loads)).usual_seconds();
    return method.kind->predict(surface, method).work.usual_seconds();
}

/// Whether it takes at most ten times as long as the answer, or two seconds.
bool is_quick(const SurfaceMesh& surface, Method answer, const FinerRims& rims, std::span<const UnitLoad> loads) {
    answer.mode = Mode::on_demand;
    answer.rims = 0;
    const double seconds =
        predicted_seconds(rims.surface.mesh, reference_method(answer), rims.n_constrained_triangles, rims.loads);
    return seconds <= kAlwaysSeconds ||
           seconds <= kMostTimes * predicted_seconds(surface, answer, rims.n_constrained_of_body, loads);
}

/// Nothing where it would take too long or more memory than there is, or where it would be the same answer.
std::uint64_t affordable_memory(const SurfaceMesh& surface, const Method& answer, const FinerRims& rims,
                                std::span<const UnitLoad> loads) {
    const SurfaceMesh& fine = rims.surface.mesh;
    const std::uint64_t bytes = galerkin_answer_memory(fine, reference_method(answer), rims.n_constrained_triangles,
                                                       3 * rims.n_constrained_triangles);
    const bool fits = fine.n_vertices() <= kMostVertices && bytes < available_memory_bytes();
    const bool differs = rims.is_finer || answer.kind != kGalerkinBem;
    return differs && fits && is_quick(surface, answer, rims, loads) ? bytes : 0;
}

/// What holds a body that is pinned bears nothing, so that nothing is singular there.
LoneVertices lone_vertices(bool pinned) { return pinned ? LoneVertices::kept : LoneVertices::refined; }

/// The surface of the second answer.
FinerRims reference_rims(const SurfaceMesh& surface, std::span<const int> vertices, std::span<const UnitLoad> loads,
                         bool pinned) {
    return FinerRims(surface, vertices, loads, 1, lone_vertices(pinned));
}

bool is_few_across(const SurfaceMesh& surface) { return triangles_across(surface) < kFewTrianglesAcross; }

/// Whether some closed surface bears loads all over and holds nothing, as a cavity under pressure does.
bool has_loaded_surface(const SurfaceMesh& surface, std::span<const int> vertices, std::span<const UnitLoad> loads) {
    std::vector<char> is_loaded(static_cast<std::size_t>(surface.n_triangles()), 0),
        holds(static_cast<std::size_t>(surface.n_vertices()), 0);
    for (const UnitLoad& load : loads)
        for (const int t : load.triangles) is_loaded[static_cast<std::size_t>(t)] = 1;
    for (const int v : vertices) holds[static_cast<std::size_t>(v)] = 1;
    const auto bears = [&](int t) {
        return is_loaded[static_cast<std::size_t>(t)] != 0 &&
               std::none_of(surface.triangles.col(t).begin(), surface.triangles.col(t).end(),
                            [&](int v) { return holds[static_cast<std::size_t>(v)] != 0; });
    };
    const std::vector<std::vector<int>> parts = connected_components(surface, EdgeTable(surface)).triangles();
    return std::any_of(parts.begin(), parts.end(),
                       [&](const std::vector<int>& part) { return std::all_of(part.begin(), part.end(), bears); });
}

/// That of a surface of few triangles across: all are halved. Nothing where that would take too long.
std::optional<FinerRims> halved_surface(const SurfaceMesh& surface, const Method& answer, std::span<const int> vertices,
                                        std::span<const UnitLoad> loads, LoneVertices lone) {
    if (surface.n_triangles() > kMostVertices / 2) return {};  // halved, a closed surface has twice as many vertices
    FinerRims halved(surface, vertices, loads, std::max(answer.rims, 1), lone, Halved::all);
    if (affordable_memory(surface, answer, halved, loads) == 0) return {};
    return halved;
}

/// values: at the nodes of the set, then the loads' factors. Throws NotHeldError, SolveError, Cancelled.
NodeSolution solve_by_galerkin(const SurfaceMesh& surface, const Method& method, const SurfaceSet& set,
                               double poisson_ratio, Eigen::VectorXd values, Control& control) {
    const ParticularField particular =
        particular_field(surface, poisson_ratio, surface.vertices(Eigen::all, set.vertices), set.loads);
    const Eigen::VectorXd factors = values.tail(std::ssize(set.loads));
    if (!particular.empty()) values.head(particular.at_nodes.rows()) -= particular.at_nodes * factors;
    const auto whole = [&](NodeSolution solution) {
        if (!particular.empty()) solution.displacements += particular.at_vertices * factors;
        return solution;
    };
    StageTimes stages;
    if (is_hierarchical(surface, method)) {
        const auto system = std::make_shared<const HierarchicalSystem>(surface, poisson_ratio, method, stages, control);
        const GalerkinTractions tractions(surface, system->surfaces(), set.vertices);
        return whole(HierarchicalSolver(system, set.vertices, tractions, set.loads, true, control)
                         .solve_watched(values, true, kSolveTolerance, control));
    }
    const GalerkinSystem system(std::make_shared<const Boundary>(surface), poisson_ratio, method, nullptr, stages,
                                control);
    const GalerkinTractions tractions(surface, system.surfaces(), set.vertices);
    return whole(
        GalerkinDirectSolver(system, system.hypersingular(control), set.vertices, tractions, set.loads, control)
            .solve(values, true));
}

/// The body's part of such a solution. values: at the body's constrained vertices, then the loads' factors.
std::optional<ReferenceAnswer> reference_on(const SurfaceMesh& surface, const Method& method, const SurfaceSet& set,
                                            int n_vertices, double poisson_ratio, const Eigen::VectorXd& values,
                                            Control& control) {
    const Eigen::Index n_loads = std::ssize(set.loads), n_prescribed = values.size() - n_loads;
    Eigen::VectorXd of_nodes(set.nodes.prescribe.rows() + n_loads);
    of_nodes << set.nodes.prescribe * values.head(n_prescribed), values.tail(n_loads);
    try {
        const NodeSolution solution =
            solve_by_galerkin(surface, method, set, poisson_ratio, std::move(of_nodes), control);
        return ReferenceAnswer{
            solution.displacements.col(0).head(3 * n_vertices),
            gathered_reactions(set.shares, static_cast<int>(n_prescribed / 3), solution.loads.col(0))};
    } catch (const SolveError&) {  // not held, or no convergence: the answer stands without an estimate
        return {};
    }
}

/// On finer rims, or on a surface that is finer everywhere.
std::optional<ReferenceAnswer> reference_on(const FinerRims& fine, const SurfaceMesh& surface, const Method& answer,
                                            const PinnedBody& body, double poisson_ratio, Control& control) {
    std::optional<ReferenceAnswer> reference = reference_on(
        fine.surface.mesh, reference_method(answer), fine, surface.n_vertices(), poisson_ratio, body.values(), control);
    if (reference) reference = body.released(*std::move(reference));
    return reference;
}

}  // namespace

std::optional<ReferenceAnswer> galerkin_reference(const SurfaceMesh& surface, const Method& answer,
                                                  double poisson_ratio, std::span<const int> vertices,
                                                  std::span<const UnitLoad> loads, const Eigen::VectorXd& values,
                                                  const Eigen::VectorXd& first, Control& control) {
    const PinnedBody body(surface.vertices, vertices, values, first);
    if (answer.kind != kGalerkinBem && is_few_across(surface)) {
        const auto halved = halved_surface(surface, answer, body.vertices(), loads, lone_vertices(body.is_pinned()));
        if (!halved) return {};  // finer rims would be as wrong as this answer
        return reference_on(*halved, surface, answer, body, poisson_ratio, control);
    }
    const FinerRims rims = reference_rims(surface, body.vertices(), loads, body.is_pinned());
    if (affordable_memory(surface, answer, rims, loads) == 0) return {};
    return reference_on(rims, surface, answer, body, poisson_ratio, control);
}

std::uint64_t galerkin_reference_memory(const SurfaceMesh& surface, const Method& answer,
                                        std::span<const int> vertices) {
    const bool pinned = !holds(surface.vertices, vertices);
    if (answer.kind != kGalerkinBem && is_few_across(surface)) {
        const auto halved = halved_surface(surface, answer, vertices, {}, lone_vertices(pinned));
        return halved ? affordable_memory(surface, answer, *halved, {}) : 0;
    }
    return affordable_memory(surface, answer, reference_rims(surface, vertices, {}, pinned), {});
}

std::optional<ReferenceAnswer> galerkin_self_reference(const SurfaceMesh& surface, const Method& answer,
                                                       double poisson_ratio, std::span<const int> vertices,
                                                       std::span<const UnitLoad> loads, const Eigen::VectorXd& values,
                                                       const Eigen::VectorXd& first, Control& control) {
    std::optional<ReferenceAnswer> reference;
    const PinnedBody body(surface.vertices, vertices, values, first);
    const bool few_across = is_few_across(surface), loaded = has_loaded_surface(surface, vertices, loads);
    const auto halved = few_across || loaded
                            ? halved_surface(surface, answer, body.vertices(), loads, LoneVertices::kept)
                            : std::nullopt;
    if (few_across && !halved) return {};  // finer rims would be as wrong as this answer
    if (halved) {
        reference = reference_on(*halved, surface, answer, body, poisson_ratio, control);
        if (reference) reference->share = kShareOfHalving;
        return reference;
    }
    if (answer.rims == 0) {
        reference = galerkin_reference(surface, answer, poisson_ratio, vertices, loads, values, first, control);
        if (reference) reference->share = loaded ? kShareOfRimsUnderLoads : kShareOfRims;
        return reference;
    }
    if (!FinerRims(surface, vertices, loads, answer.rims, LoneVertices::kept).is_finer) return {};
    const SurfaceSet given(surface, body.vertices(), loads);
    reference = reference_on(surface, reference_method(answer), given, surface.n_vertices(), poisson_ratio,
                             body.values(), control);
    if (!reference) return {};
    reference = body.released(*std::move(reference));
    reference->share = -kShareLeft[static_cast<std::size_t>(answer.rims) - 1];
    return reference;
}

std::uint64_t galerkin_halved_memory(const SurfaceMesh& surface, const Method& answer, std::span<const int> vertices) {
    const bool may_be_loaded = connected_components(surface, EdgeTable(surface)).count > 1;
    if (!may_be_loaded && !is_few_across(surface)) return 0;
    const std::optional<FinerRims> halved = halved_surface(surface, answer, vertices, {}, LoneVertices::kept);
    return halved ? affordable_memory(surface, answer, *halved, {}) : 0;
}

}  // namespace elastolab
