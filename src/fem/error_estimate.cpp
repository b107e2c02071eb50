#include "fem/error_estimate.hpp"

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/memory.hpp"
#include "deform/node_rows.hpp"
#include "deform/pinned_body.hpp"
#include "fem/constrained_nodes.hpp"
#include "fem/constraints.hpp"
#include "fem/halved_mesh.hpp"
#include "fem/load_vectors.hpp"
#include "fem/stiffness_product.hpp"

namespace elastolab {

namespace {

/// IterationOptions::energy_tolerance where the answer that is judged is the worse one by far.
constexpr double kEnoughOfLinear = 0.01;
/// Where the better answer changes more of the energy than kFarOff, as of bars one or two cells across, forces are
/// small differences of what is left of large ones: of that only kRestOfFarOff stays. Rods of 100 times their thickness
/// under a force, whose reactions are exact, were told to be off by 66 to 95 %.
constexpr double kFarOff = 0.3, kRestOfFarOff = 0.1;
/// Bytes of elements, their interpolation and vectors for each quadratic node; and for each node of quadratic elements
/// that are halved, where there are eight in place of it.
constexpr std::uint64_t kBytesOfQuadraticNode = 1500, kBytesOfHalvedNode = 14000;

/// forces: of all nodes, the given ones among them.
Reactions reactions_of(const Eigen::VectorXd& forces, const Eigen::VectorXd& given,
                       const ConstrainedFemNodes& constrained, std::size_t n_vertices) {
    return gathered_reactions(constrained.shares, static_cast<int>(n_vertices),
                              rows_of(forces - given, constrained.prescribed.nodes).col(0));
}

/// Of the stiffness with these nodes eliminated, made where it is not at hand.
Factor factor_for(const PinnedBody& body, const FemSystem& system, const std::vector<int>& nodes, const Factor& held,
                  Control& control) {
    if (held && !body.is_pinned()) return held;
    return std::make_shared<const SparseCholesky>(*system.mesh->analysis, eliminated(system.K, nodes),
                                                  "stiffness matrix", &control);
}

/// Bytes of such a factor, and of the matrix that it is made of.
std::uint64_t factor_memory(const FemSystem& system) {
    return system.mesh->analysis->factor_bytes() + 12 * static_cast<std::uint64_t>(system.K.nonZeros());
}

/// What quadratic elements are asked for, and a coarser space inside theirs.
struct LevelsProblem {
    const QuadraticMesh& mesh;
    SparseMatrix prolongation;  ///< from the coarse nodes; they are the vertices of the mesh, in their order
    std::span<const int> vertices;
    Eigen::VectorXd values;               ///< prescribed displacements of these
    Eigen::VectorXd coarse_given, given;  ///< forces at all nodes of each
    double enough = 0.0;                  ///< IterationOptions::energy_tolerance
};

struct NodalAnswer {
    Eigen::VectorXd displacements;  ///< of all nodes
    Reactions reactions;            ///< at the vertices
};

NodalAnswer answer_by_levels(const LevelsProblem& problem, const ReferenceOperators& apply, Control& control) {
    const QuadraticMesh& mesh = problem.mesh;
    const ConstrainedFemNodes constrained =
        constrain_nodes(mesh.positions, {mesh.triangles, mesh.midpoints}, {}, problem.vertices);
    const TwoLevels levels(mesh, problem.prolongation, constrained.prescribed.nodes);
    Eigen::VectorXd u = Eigen::VectorXd::Zero(problem.prolongation.cols());
    for (std::size_t i = 0; i < problem.vertices.size(); ++i)
        u.segment<3>(3 * problem.vertices[i]) = problem.values.segment<3>(3 * static_cast<Eigen::Index>(i));
    Eigen::VectorXd load = problem.coarse_given - apply.coarse(u);
    for (const int v : problem.vertices) load.segment<3>(3 * v).setZero();
    control.checkpoint();
    u += apply.solve_coarse(load);
    u = (problem.prolongation * u).eval();
    Eigen::VectorXd forces = apply.stiffness(u);
    Eigen::VectorXd change = levels.solve(apply, problem.given - forces, problem.enough, control);
    const Eigen::VectorXd of_change = apply.stiffness(change);
    const bool far_off = change.dot(of_change) > kFarOff * u.dot(forces);
    u += change;
    forces += of_change;
    if (far_off) {
        change = levels.solve(apply, problem.given - forces, kRestOfFarOff, control);
        u += change;
        forces += apply.stiffness(change);
    }
    return {u, reactions_of(forces, problem.given, constrained, problem.vertices.size())};
}

}  // namespace

/// Nodes of quadratic elements by Euler's formula: vertices - edges + faces - tetrahedra = 1 for a ball.
std::uint64_t quadratic_reference_memory(const FemSystem& linear, bool has_factor) {
    const TetMesh& tets = linear.mesh->tets;
    const std::int64_t n_edges = tets.n_vertices() + tets.n_tetrahedra() + tets.n_surface_vertices;
    return (has_factor ? 0 : factor_memory(linear)) +
           kBytesOfQuadraticNode * static_cast<std::uint64_t>(tets.n_vertices() + n_edges);
}

std::uint64_t halved_reference_memory(const FemSystem& quadratic, bool has_factor) {
    return (has_factor ? 0 : factor_memory(quadratic)) +
           kBytesOfHalvedNode * static_cast<std::uint64_t>(quadratic.mesh->tets.n_vertices());
}

std::optional<ReferenceAnswer> quadratic_reference(const FemSystem& linear, double poisson_ratio,
                                                   std::span<const int> vertices, std::span<const UnitLoad> loads,
                                                   const Eigen::VectorXd& values, const Eigen::VectorXd& first,
                                                   const Factor& held, Control& control) {
    const PinnedBody body(linear.positions().leftCols(linear.n_vertices()), vertices, values, first);
    if (!body.is_held() || !can_be_judged(poisson_ratio)) return {};
    control.checkpoint();
    const QuadraticMesh mesh(linear.mesh->tets);
    if (quadratic_reference_memory(linear, held && !body.is_pinned()) > available_memory_bytes()) return {};
    const StiffnessProduct stiffness(mesh, Material{1.0, poisson_ratio});
    const Eigen::Matrix3Xd diagonal = stiffness.diagonal();
    const Factor factor = factor_for(body, linear, body.vertices(), held, control);
    ReferenceOperators apply;
    apply.coarse = [&](const Eigen::VectorXd& u) -> Eigen::VectorXd { return linear.K * u; };
    apply.stiffness = [&](const Eigen::VectorXd& u) -> Eigen::VectorXd { return stiffness(u); };
    apply.solve_coarse = [&](const Eigen::VectorXd& f) -> Eigen::VectorXd { return factor->solve(f).col(0); };
    apply.diagonal = [&](int node) -> Eigen::Matrix3d { return diagonal.middleCols<3>(3 * node); };
    return body.released(
        quadratic_reference(mesh, *linear.mesh, apply, body.vertices(), loads, body.values(), control));
}

ReferenceAnswer quadratic_reference(const QuadraticMesh& mesh, const FemMesh& linear, const ReferenceOperators& apply,
                                    std::span<const int> vertices, std::span<const UnitLoad> loads,
                                    const Eigen::VectorXd& values, Control& control) {
    const Eigen::VectorXd factors = values.tail(std::ssize(loads));
    const NodalAnswer fine = answer_by_levels({.mesh = mesh,
                                               .prolongation = from_corners(mesh),
                                               .vertices = vertices,
                                               .values = values.head(3 * std::ssize(vertices)),
                                               .coarse_given = load_vectors(linear, loads) * factors,
                                               .given = load_vectors(mesh, linear, loads) * factors,
                                               .enough = kEnoughOfLinear},
                                              apply, control);
    return ReferenceAnswer{fine.displacements.head(3 * linear.tets.n_surface_vertices), fine.reactions,
                           1.0 + kLeftByQuadratic};
}

std::optional<ReferenceAnswer> halved_reference(const FemSystem& quadratic, double poisson_ratio,
                                                std::span<const int> vertices, std::span<const UnitLoad> loads,
                                                const Eigen::VectorXd& values, const Eigen::VectorXd& first,
                                                const Factor& held, Control& control) {
    const PinnedBody body(quadratic.positions().leftCols(quadratic.n_vertices()), vertices, values, first);
    if (!body.is_held() || !can_be_judged(poisson_ratio) ||
        halved_reference_memory(quadratic, held && !body.is_pinned()) > available_memory_bytes())
        return {};
    const ConstrainedFemNodes nodes =
        constrain_nodes(quadratic.positions(), quadratic.mesh->midpoints, {}, body.vertices());
    const Factor factor = factor_for(body, quadratic, nodes.prescribed.nodes, held, control);
    return body.released(halved_reference(
        *quadratic.mesh, poisson_ratio, [&](const Eigen::VectorXd& u) -> Eigen::VectorXd { return quadratic.K * u; },
        [&](const Eigen::VectorXd& f) -> Eigen::VectorXd { return factor->solve(f).col(0); }, body.vertices(), loads,
        body.values(), control));
}

ReferenceAnswer halved_reference(const FemMesh& quadratic, double poisson_ratio, const TwoLevels::Product& stiffness,
                                 const TwoLevels::Product& solve, std::span<const int> vertices,
                                 std::span<const UnitLoad> loads, const Eigen::VectorXd& values, Control& control) {
    const QuadraticMesh mesh = halved_mesh(quadratic.tets, quadratic.n_surface_nodes);
    const StiffnessProduct fine(mesh, Material{1.0, poisson_ratio});
    const Eigen::Matrix3Xd diagonal = fine.diagonal();
    const ConstrainedFemNodes nodes = constrain_nodes(quadratic.tets.vertices, quadratic.midpoints, {}, vertices);
    ReferenceOperators apply;
    apply.coarse = stiffness;
    apply.solve_coarse = solve;
    apply.stiffness = [&](const Eigen::VectorXd& u) -> Eigen::VectorXd { return fine(u); };
    apply.diagonal = [&](int node) -> Eigen::Matrix3d { return diagonal.middleCols<3>(3 * node); };
    const Eigen::VectorXd factors = values.tail(std::ssize(loads));
    const Triangles surface = quarters(quadratic.surface, quadratic.surface_midpoints);
    const NodalAnswer answer =
        answer_by_levels({.mesh = mesh,
                          .prolongation = from_whole(mesh, quadratic.elements()),
                          .vertices = nodes.prescribed.nodes,
                          .values = nodes.prescribed.prescribe * values.head(3 * std::ssize(vertices)),
                          .coarse_given = load_vectors(quadratic, loads) * factors,
                          .given = load_vectors(mesh, surface, on_quarters(loads)) * factors,
                          .enough = kEnoughOfHalved},
                         apply, control);
    return {answer.displacements.head(3 * quadratic.tets.n_surface_vertices),
            gathered_reactions(nodes.shares, static_cast<int>(vertices.size()), answer.reactions.forces.reshaped()),
            1.0 + kLeftByHalving};
}

}  // namespace elastolab
