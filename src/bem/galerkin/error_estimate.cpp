#include "bem/galerkin/error_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "base/memory.hpp"
#include "bem/cost.hpp"
#include "bem/galerkin/cost.hpp"
#include "bem/galerkin/hierarchical_system.hpp"
#include "bem/galerkin/method.hpp"
#include "bem/galerkin/solvers.hpp"
#include "bem/given_loads.hpp"
#include "mesh/refine.hpp"
#include "mesh/topology.hpp"

namespace elastolab {

namespace {

/// Relative tolerance of the integrals: far stricter than an estimate needs.
constexpr double kReferenceTolerance = 1e-6;
/// Vertices above which the reference would take many minutes.
constexpr int kMostVertices = 20000;
/// It may take this many times as long as the answer, or this many seconds.
constexpr double kMostTimes = 10.0, kAlwaysSeconds = 0.2;
/// Faces turn into the body at a re-entrant edge by more than this angle, in radians: at less, curved surfaces in flat
/// triangles have such edges everywhere.
constexpr double kReentrant = 0.8;
/// Error of Galerkin BEM over what halving the rims changes. The first order alone would make it 2; what other
/// triangles contribute is partly of the other sign. tests/methods/discretisation_test.cpp measures it.
constexpr double kShareOfRims = 1.4;

/// The problem on a surface with finer rims. Its first vertices are those of the surface.
struct RimProblem {
    RefinedSurface surface;
    std::vector<int> vertices;  ///< constrained
    Eigen::VectorXd values;     ///< of the vertices, then of the loads
    std::vector<UnitLoad> loads = {};
    std::int64_t n_constrained_triangles = 0;
};

std::vector<char> constrained_triangles(const SurfaceMesh& surface, const std::vector<int>& place) {
    std::vector<char> inside;
    for (const auto& t : surface.triangles.colwise())
        inside.push_back(
            std::all_of(t.begin(), t.end(), [&](int v) { return place[static_cast<std::size_t>(v)] >= 0; }) ? 1 : 0);
    return inside;
}

void mark_around_reentrant_edges(const SurfaceMesh& surface, std::vector<char>& marked) {
    const auto corner = [&](int t, int k) -> Eigen::Vector3d {
        return surface.vertices.col(surface.triangles(k % 3, t));
    };
    const auto normal = [&](int t) -> Eigen::Vector3d {
        return (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0)).normalized();
    };
    const EdgeTable edges(surface);
    std::vector<char> at_edge(static_cast<std::size_t>(surface.n_vertices()), 0);
    for (int e = 0; e < edges.size(); ++e) {
        const auto halves = edges.half_edges(e);
        if (halves.size() != 2) continue;
        const int t = halves[0] / 3, s = halves[1] / 3;
        const Eigen::Vector3d along = corner(t, halves[0] % 3 + 1) - corner(t, halves[0] % 3);
        const double turn = std::atan2(normal(t).cross(normal(s)).dot(along.normalized()), normal(t).dot(normal(s)));
        if (turn > -kReentrant) continue;  // convex edges turn by a positive angle
        at_edge[static_cast<std::size_t>(edges[e].a)] = at_edge[static_cast<std::size_t>(edges[e].b)] = 1;
    }
    for (int t = 0; t < surface.n_triangles(); ++t)
        for (const int v : surface.triangles.col(t))
            if (at_edge[static_cast<std::size_t>(v)]) marked[static_cast<std::size_t>(t)] = 1;
}

/// Marks those around the rims, and those at re-entrant edges, and around constrained vertices without a constrained
/// triangle.
std::vector<char> triangles_to_split(const SurfaceMesh& surface, const std::vector<int>& place,
                                     const std::vector<char>& inside) {
    std::vector<char> marked = around_rim(unrefined(surface), inside);
    mark_around_reentrant_edges(surface, marked);
    std::vector<char> lone(place.size(), 0);
    for (std::size_t v = 0; v < place.size(); ++v) lone[v] = place[v] >= 0 ? 1 : 0;
    for (int t = 0; t < surface.n_triangles(); ++t)
        for (const int v : surface.triangles.col(t))
            if (inside[static_cast<std::size_t>(t)]) lone[static_cast<std::size_t>(v)] = 0;
    for (int t = 0; t < surface.n_triangles(); ++t)
        for (const int v : surface.triangles.col(t))
            if (lone[static_cast<std::size_t>(v)]) marked[static_cast<std::size_t>(t)] = 1;
    return marked;
}

/// The loads of the triangles that the finer ones are parts of.
std::vector<UnitLoad> on_finer_triangles(const RefinedSurface& fine, std::span<const UnitLoad> loads) {
    std::vector<UnitLoad> result(loads.begin(), loads.end());
    for (UnitLoad& load : result) {
        std::vector<int> place(fine.coarse_triangle.size(), -1), columns, triangles;  // no more coarse ones than fine
        for (std::size_t k = 0; k < load.triangles.size(); ++k)
            place[static_cast<std::size_t>(load.triangles[k])] = static_cast<int>(k);
        for (std::size_t t = 0; t < fine.coarse_triangle.size(); ++t)
            if (const int k = place[static_cast<std::size_t>(fine.coarse_triangle[t])]; k >= 0) {
                triangles.push_back(static_cast<int>(t));
                columns.push_back(k);
            }
        load.tractions = Eigen::Matrix3Xd(load.tractions(Eigen::all, columns));
        load.triangles = std::move(triangles);
    }
    return result;
}

RimProblem with_finer_rims(const SurfaceMesh& surface, std::span<const int> vertices, std::span<const UnitLoad> loads,
                           const Eigen::VectorXd& values) {
    std::vector<int> place(static_cast<std::size_t>(surface.n_vertices()), -1);
    Eigen::Matrix3Xd field = Eigen::Matrix3Xd::Zero(3, surface.n_vertices());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        place[static_cast<std::size_t>(vertices[i])] = static_cast<int>(i);
        field.col(vertices[i]) = values.segment<3>(3 * static_cast<Eigen::Index>(i));
    }
    const std::vector<char> inside = constrained_triangles(surface, place);
    RimProblem problem{refine_marked(unrefined(surface), triangles_to_split(surface, place, inside)), {}, {}};
    const RefinedSurface& fine = problem.surface;
    std::vector<char> is_constrained(static_cast<std::size_t>(fine.mesh.n_vertices()), 0);
    for (const int v : vertices) is_constrained[static_cast<std::size_t>(v)] = 1;
    for (int t = 0; t < fine.mesh.n_triangles(); ++t)
        if (inside[static_cast<std::size_t>(fine.coarse_triangle[static_cast<std::size_t>(t)])]) {
            ++problem.n_constrained_triangles;
            for (const int v : fine.mesh.triangles.col(t)) is_constrained[static_cast<std::size_t>(v)] = 1;
        }
    for (int v = 0; v < fine.mesh.n_vertices(); ++v)
        if (is_constrained[static_cast<std::size_t>(v)]) problem.vertices.push_back(v);
    problem.loads = on_finer_triangles(fine, loads);
    problem.values.resize(3 * std::ssize(problem.vertices) + std::ssize(loads));
    problem.values << fine.interpolate(field)(Eigen::all, problem.vertices).reshaped(), values.tail(std::ssize(loads));
    return problem;
}

/// Reactions of the fine problem at the constrained vertices of the coarse one.
Reactions on_coarse_vertices(const RimProblem& problem, const Eigen::VectorXd& loads, std::span<const int> vertices) {
    const SurfaceMesh& fine = problem.surface.mesh;
    Eigen::Matrix3Xd forces = Eigen::Matrix3Xd::Zero(3, fine.n_vertices()), moments = forces;
    for (std::size_t i = 0; i < problem.vertices.size(); ++i) {
        const int v = problem.vertices[i];
        forces.col(v) = loads.segment<3>(3 * static_cast<Eigen::Index>(i));
        moments.col(v) = fine.vertices.col(v).cross(forces.col(v));
    }
    const std::vector<int> wanted(vertices.begin(), vertices.end());
    return {problem.surface.gather(forces)(Eigen::all, wanted), problem.surface.gather(moments)(Eigen::all, wanted)};
}

Method reference_method() {
    return {.kind = kGalerkinBem, .update = Update::direct, .integral_tolerance = kReferenceTolerance};
}

/// Whether it takes at most ten times as long as the answer, or a fifth of a second.
bool is_quick(const SurfaceMesh& surface, const SurfaceMesh& fine, Method answer) {
    Method reference = reference_method();
    answer.mode = Mode::on_demand;
    answer.update = reference.update = Update::reduced;  // which factorises what the others do for each set
    const double seconds = reference.kind->predict(fine, reference).seconds;
    return seconds <= kAlwaysSeconds || seconds <= kMostTimes * answer.kind->predict(surface, answer).seconds;
}

/// Nothing where it would take too long or more memory than there is.
std::uint64_t affordable_memory(const SurfaceMesh& surface, const Method& answer, const RimProblem& problem) {
    const SurfaceMesh& fine = problem.surface.mesh;
    const std::int64_t n_tractions = 3 * problem.n_constrained_triangles;
    const std::uint64_t bytes =
        is_hierarchical(fine, reference_method())
            ? predict_galerkin_bem(fine, reference_method()).memory_bytes +
                  hierarchical_set_memory(fine.n_vertices(), problem.n_constrained_triangles, n_tractions)
            : galerkin_direct_memory(3 * fine.n_vertices(), n_tractions);
    const bool fits = fine.n_vertices() <= kMostVertices && bytes < available_memory_bytes();
    return fits && is_quick(surface, fine, answer) ? bytes : 0;
}

/// Throws NotHeldError, SolveError, Cancelled.
NodeSolution solve_by_galerkin(const RimProblem& problem, double poisson_ratio, Control& control) {
    const SurfaceMesh& fine = problem.surface.mesh;
    const ParticularField particular =
        particular_field(fine, poisson_ratio, fine.vertices(Eigen::all, problem.vertices), problem.loads);
    const Eigen::VectorXd factors = problem.values.tail(std::ssize(problem.loads));
    Eigen::VectorXd values = problem.values;
    if (!particular.empty()) values.head(particular.at_nodes.rows()) -= particular.at_nodes * factors;
    const auto whole = [&](NodeSolution solution) {
        if (!particular.empty()) solution.displacements += particular.at_vertices * factors;
        return solution;
    };
    StageTimes stages;
    if (is_hierarchical(fine, reference_method())) {
        const auto system =
            std::make_shared<const HierarchicalSystem>(fine, poisson_ratio, reference_method(), stages, control);
        const GalerkinTractions tractions(fine, system->surfaces(), problem.vertices);
        return whole(HierarchicalSolver(system, problem.vertices, tractions, problem.loads, true, control)
                         .solve_watched(values, true, kSolveTolerance, control));
    }
    const GalerkinSystem system(std::make_shared<const Boundary>(fine), poisson_ratio, reference_method(), nullptr,
                                stages, control);
    const GalerkinTractions tractions(fine, system.surfaces(), problem.vertices);
    return whole(GalerkinDirectSolver(system, problem.vertices, tractions, problem.loads, control).solve(values, true));
}

}  // namespace

std::optional<ReferenceAnswer> galerkin_reference(const SurfaceMesh& surface, const Method& answer,
                                                  double poisson_ratio, std::span<const int> vertices,
                                                  std::span<const UnitLoad> loads, const Eigen::VectorXd& values,
                                                  Control& control) {
    const RimProblem problem = with_finer_rims(surface, vertices, loads, values);
    if (affordable_memory(surface, answer, problem) == 0) return {};
    try {
        const NodeSolution solution = solve_by_galerkin(problem, poisson_ratio, control);
        return ReferenceAnswer{solution.displacements.col(0).head(3 * surface.n_vertices()),
                               on_coarse_vertices(problem, solution.loads.col(0), vertices)};
    } catch (const SolveError&) {  // not held, or no convergence: the answer stands without an estimate
        return {};
    }
}

std::uint64_t galerkin_reference_memory(const SurfaceMesh& surface, const Method& answer,
                                        std::span<const int> vertices) {
    return affordable_memory(surface, answer,
                             with_finer_rims(surface, vertices, {}, Eigen::VectorXd::Zero(3 * std::ssize(vertices))));
}

std::optional<ReferenceAnswer> galerkin_self_reference(const SurfaceMesh& surface, const Method& answer,
                                                       double poisson_ratio, std::span<const int> vertices,
                                                       std::span<const UnitLoad> loads, const Eigen::VectorXd& values,
                                                       Control& control) {
    std::optional<ReferenceAnswer> reference =
        galerkin_reference(surface, answer, poisson_ratio, vertices, loads, values, control);
    if (reference) reference->share = kShareOfRims;
    return reference;
}

}  // namespace elastolab
