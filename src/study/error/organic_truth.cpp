#include "study/error/organic_truth.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <Eigen/Geometry>
#include <utility>
#include <vector>

#include "deform/patch_reactions.hpp"
#include "fem/assembly.hpp"
#include "fem/load_vectors.hpp"
#include "fem/prescribed.hpp"
#include "fem/quadratic_mesh.hpp"
#include "mesh/measures.hpp"
#include "mesh/rims.hpp"
#include "mesh/tets/tetrahedralize.hpp"

namespace elastolab {

namespace {

/// The problem on the coarse surface.
struct TruthProblem {
    const SurfaceMesh& surface;
    Positions values;             // of all vertices, zero where free
    std::vector<char> is_free;    // by vertex
    std::vector<char> in_region;  // by triangle
    Material material;
    const GivenLoads& given;
};

TruthProblem make_problem(const SurfaceMesh& surface, std::span<const int> constrained, const Positions& values,
                          const Material& material, const GivenLoads& given) {
    TruthProblem problem{surface, Positions::Zero(3, surface.n_vertices()), {}, {}, material, given};
    problem.is_free.assign(static_cast<std::size_t>(surface.n_vertices()), 1);
    for (std::size_t k = 0; k < constrained.size(); ++k) {
        problem.is_free[static_cast<std::size_t>(constrained[k])] = 0;
        problem.values.col(constrained[k]) = values.col(static_cast<Eigen::Index>(k));
    }
    std::vector<char> in_triangle(problem.is_free.size(), 0);
    for (const auto& triangle : surface.triangles.colwise()) {
        const bool inside = std::none_of(triangle.begin(), triangle.end(),
                                         [&](int v) { return problem.is_free[static_cast<std::size_t>(v)] != 0; });
        problem.in_region.push_back(inside ? 1 : 0);
        for (int v : triangle) in_triangle[static_cast<std::size_t>(v)] |= inside ? 1 : 0;
    }
    assert(std::all_of(constrained.begin(), constrained.end(),
                       [&](int v) { return in_triangle[static_cast<std::size_t>(v)] != 0; }));
    return problem;
}

struct Solution {
    Positions u;                // of the coarse vertices
    Positions forces, moments;  // likewise
    int n_nodes = 0;
};

/// Nodal forces of a quadratic mesh, gathered at its surface vertices: a midpoint's go by halves to its edge's ends.
Positions on_vertices(const QuadraticMesh& mesh, Positions at_nodes) {
    std::vector<char> moved(static_cast<std::size_t>(mesh.n_nodes()), 0);
    for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
        for (int i = 0; i < 3; ++i) {
            const int node = mesh.midpoints(i, t);
            if (std::exchange(moved[static_cast<std::size_t>(node)], 1) != 0) continue;
            at_nodes.col(mesh.triangles(i, t)) += 0.5 * at_nodes.col(node).eval();
            at_nodes.col(mesh.triangles((i + 1) % 3, t)) += 0.5 * at_nodes.col(node).eval();
        }
    return at_nodes.leftCols(mesh.n_surface_vertices);
}

/// `inside`: bound on the volume of a tetrahedron, in units of the regular one with this edge.
TetMesh fill(const RefinedSurface& refined, double edge, double inside) {
    Control control;
    const double ratio = edge / mean_edge(refined.mesh);
    return tetrahedralize(refined.mesh, "truth",
                          {.radius_edge_ratio = 1.4, .relative_volume = inside * std::pow(ratio, 3), .growth = 0.0},
                          control);
}

/// Nodal forces of the loads, 3*n_nodes; empty where there are none.
Eigen::MatrixXd given_forces(const RefinedSurface& refined, const QuadraticMesh& mesh, const TruthProblem& problem) {
    if (problem.given.loads.empty()) return {};
    std::vector<UnitLoad> loads = problem.given.loads;
    for (UnitLoad& load : loads) {
        if (load.is_body_force()) continue;
        std::vector<int> place(static_cast<std::size_t>(problem.surface.n_triangles()), -1), fine, from;
        for (std::size_t k = 0; k < load.triangles.size(); ++k)
            place[static_cast<std::size_t>(load.triangles[k])] = static_cast<int>(k);
        for (int t = 0; t < refined.mesh.n_triangles(); ++t)
            if (const int k = place[static_cast<std::size_t>(refined.coarse_triangle[static_cast<std::size_t>(t)])];
                k >= 0) {
                fine.push_back(t);
                from.push_back(k);
            }
        load.tractions = Eigen::Matrix3Xd(load.tractions(Eigen::all, from));
        load.triangles = std::move(fine);
    }
    return load_vectors(mesh, refined.mesh.triangles, loads) * problem.given.factors;
}

Solution solve_on(const RefinedSurface& refined, const TetMesh& tetrahedra, const TruthProblem& problem) {
    const QuadraticMesh mesh(tetrahedra);
    const Positions prescribed = refined.interpolate(problem.values);
    Positions at_nodes = Positions::Zero(3, mesh.n_nodes());
    std::vector<char> is_prescribed(static_cast<std::size_t>(mesh.n_nodes()), 0);
    const auto prescribe = [&](int node, const Eigen::Vector3d& value) {
        is_prescribed[static_cast<std::size_t>(node)] = 1;
        at_nodes.col(node) = value;
    };
    for (Eigen::Index t = 0; t < refined.mesh.triangles.cols(); ++t) {
        if (!problem.in_region[static_cast<std::size_t>(refined.coarse_triangle[static_cast<std::size_t>(t)])])
            continue;
        const Eigen::Vector3i v = refined.mesh.triangles.col(t);
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3;
            prescribe(v[i], prescribed.col(v[i]));
            prescribe(mesh.midpoint(v[i], v[j]), 0.5 * (prescribed.col(v[i]) + prescribed.col(v[j])));
        }
    }
    std::vector<int> nodes;
    for (int node = 0; node < mesh.n_nodes(); ++node)
        if (is_prescribed[static_cast<std::size_t>(node)]) nodes.push_back(node);
    Control control;
    const SparseMatrix K = stiffness(assemble_stiffness_parts(mesh, control), problem.material);
    const Positions values = at_nodes(Eigen::all, nodes);
    const PrescribedSolution solved = solve_prescribed(K, CholeskyAnalysis(K), nodes, values.reshaped(), control,
                                                       given_forces(refined, mesh, problem));
    Positions forces = Positions::Zero(3, mesh.n_nodes()), moments = forces;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Eigen::Vector3d force = solved.forces.col(0).segment<3>(3 * static_cast<Eigen::Index>(i));
        forces.col(nodes[i]) = force;
        moments.col(nodes[i]) = mesh.positions.col(nodes[i]).cross(force);
    }
    const Eigen::Index n = problem.surface.n_vertices();
    return {solved.displacements.col(0).head(3 * n).reshaped(3, n), refined.gather(on_vertices(mesh, forces)),
            refined.gather(on_vertices(mesh, moments)), mesh.n_nodes()};
}

/// Root of the sum of squares over the free vertices.
double size_of(const Positions& u, const TruthProblem& problem) {
    double sum = 0.0;
    for (Eigen::Index v = 0; v < u.cols(); ++v)
        if (problem.is_free[static_cast<std::size_t>(v)]) sum += u.col(v).squaredNorm();
    return std::sqrt(sum);
}

/// Solves on tetrahedra and on the same ones split in eight, and extrapolates. Both meshes have elements of the same
/// shapes, so that the error is halved with the element size, which two meshes by TetGen would not show.
Solution extrapolate(const RefinedSurface& refined, double edge, const TruthProblem& problem) {
    // Inside, elements may be larger than on the surface, where the solution is rough.
    constexpr double kInside = 4.0;
    const TetMesh mesh = fill(refined, edge, kInside);
    const RefinedSurface fine = refine_all(refined);
    const Solution before = solve_on(refined, mesh, problem);
    const Solution after = solve_on(fine, refine_tetrahedra(mesh, fine), problem);
    return {2.0 * after.u - before.u, 2.0 * after.forces - before.forces, 2.0 * after.moments - before.moments,
            after.n_nodes};
}

/// The reactions at the constrained vertices, in their order.
Reactions reactions_of(const Solution& solution, std::span<const int> constrained) {
    const std::vector<int> vertices(constrained.begin(), constrained.end());
    return {solution.forces(Eigen::all, vertices), solution.moments(Eigen::all, vertices)};
}

}  // namespace

OrganicTruth compute_truth(const SurfaceMesh& surface, std::span<const int> constrained, const Positions& values,
                           const Material& material, const TruthOptions& options, const GivenLoads& given) {
    assert(options.rim_refinements >= 1);
    const TruthProblem problem = make_problem(surface, constrained, values, material, given);
    const double edge = mean_edge(surface);
    RefinedSurface refined = unrefined(surface);
    Solution before, last;
    for (int round = 0; round <= options.rim_refinements; ++round) {
        if (round > 0) refined = refine_marked(refined, around_rim(refined, problem.in_region));
        if (round + 1 < options.rim_refinements) continue;
        before = std::move(last);
        last = extrapolate(refined, edge, problem);
    }
    const ConstrainedPatches patches = constrained_patches(surface, {}, constrained);
    const Reactions reactions = reactions_of(last, constrained), coarser = reactions_of(before, constrained);
    const Reactions change{reactions.forces - coarser.forces, reactions.moments - coarser.moments};
    return {last.u, reactions, size_of(last.u - before.u, problem) / size_of(last.u, problem),
            largest_patch_reaction(surface, patches, change) / largest_patch_reaction(surface, patches, reactions),
            last.n_nodes};
}

}  // namespace elastolab
