#include "fem/nonlinear/second_answer.hpp"

#include <memory>
#include <utility>

#include "deform/pinned_body.hpp"
#include "fem/error_estimate.hpp"
#include "fem/nonlinear/halved_answer.hpp"
#include "fem/quadratic_mesh.hpp"

namespace elastolab {

namespace {

/// Error that ten-node elements leave, over how much they change the answer of four-node ones: that of linear theory.
constexpr double kLeftByTenNodes = kLeftByQuadratic;
constexpr int kCheckIterations = 30;
/// Residual of ten nodes as a second answer to four.
constexpr double kCheckTolerance = 1e-3;
constexpr double kCompressibleTolerance = 1e-5;  ///< residual of the less incompressible body

/// Four nodes an element on the same tetrahedra, from where the ten nodes' corners are.
std::optional<ReferenceAnswer> linear_answer(const NonlinearMesh& mesh, const Material& material,
                                             const std::vector<int>& vertices, std::span<const UnitLoad> loads,
                                             const NodeSolution& solution, Control& control) {
    const Newton newton(std::make_shared<const FreeTangent>(mesh.linear, vertices, control), material, 0.0,
                        {mesh.linear, mesh.surface, {}, loads});
    const Eigen::VectorXd factors = solution.factors.col(0);
    NewtonWork work = newton.make_work();
    Eigen::VectorXd u(3 * mesh.linear->n_nodes());
    for (int v = 0; v < mesh.linear->n_nodes(); ++v)
        u.segment<3>(3 * v) =
            solution.displacements.col(0).segment<3>(3 * mesh.corner_nodes[static_cast<std::size_t>(v)]);
    if (!(newton.energy(u, work, control).least_J > 0.0)) return {};
    const NewtonState state = newton.run(std::move(u), factors, kSolveTolerance, kCheckIterations, work, control);
    if (!state.converged) return {};
    const Eigen::VectorXd forces = newton.forces(state.u, factors, work, control);
    const Positions present = mesh.linear->positions() + state.u.reshaped(3, mesh.linear->n_nodes());
    Eigen::VectorXd at_vertices(3 * std::ssize(vertices));
    for (std::size_t i = 0; i < vertices.size(); ++i)
        at_vertices.segment<3>(3 * static_cast<Eigen::Index>(i)) = forces.segment<3>(3 * vertices[i]);
    return ReferenceAnswer{
        state.u.head(3 * mesh.n_vertices()),
        gathered_reactions(nodal_shares(present, vertices), static_cast<int>(vertices.size()), at_vertices),
        -kLeftByTenNodes};
}

/// Ten nodes an element on the same tetrahedra, from what four of them have found.
std::optional<ReferenceAnswer> ten_node_answer(const NonlinearMesh& mesh, const Material& material,
                                               const PinnedBody& body, std::span<const UnitLoad> loads,
                                               const NodeSolution& solution, Control& control) {
    const std::shared_ptr<const NonlinearMesh> ten =
        make_nonlinear_mesh(mesh.tets, mesh.surface, ElementDegree::quadratic);
    const Eigen::MatrixXi& elements = ten->elements->elements();
    const ConstrainedFemNodes nodes = constrain_nodes(ten->elements->positions(), ten->midpoints, {}, body.vertices());
    Positions u = Positions::Zero(3, ten->elements->n_nodes());
    u(Eigen::all, ten->corner_nodes) = solution.displacements.col(0).reshaped(3, mesh.tets.n_vertices());
    for (const auto& element : elements.colwise())
        for (int e = 0; e < 6; ++e)
            u.col(element[4 + e]) = 0.5 * (u.col(element[kTetEdges[e][0]]) + u.col(element[kTetEdges[e][1]]));
    const Newton newton(std::make_shared<const FreeTangent>(ten->elements, nodes.prescribed.nodes, control), material,
                        0.0, {ten->elements, ten->surface, ten->surface_midpoints, loads});
    NewtonWork work = newton.make_work();
    const Eigen::VectorXd factors = solution.factors.col(0);
    const NewtonState state = newton.run(u.reshaped(), factors, kCheckTolerance, kCheckIterations, work, control);
    if (!state.converged) return {};
    const Eigen::VectorXd forces = newton.forces(state.u, factors, work, control);
    const Eigen::VectorXd at_nodes =
        forces.reshaped(3, ten->elements->n_nodes())(Eigen::all, nodes.prescribed.nodes).reshaped();
    return ReferenceAnswer{
        state.u.head(3 * mesh.n_vertices()),
        present_reactions(nodes.shares, body.values().head(3 * std::ssize(body.vertices())), at_nodes),
        1.0 + kLeftByTenNodes};
}

/// What a less incompressible body says of the error of this one: how far that is off, on this one's answer. Halved
/// edges judge it in one step where they do not judge this one, whose pressures are noise on them; and ten nodes do not
/// lock, so that they leave much the same. Forces are as far off as they are large.
std::optional<ReferenceAnswer> by_compressible(const JudgedAnswer& judged, const Newton& newton,
                                               const ConstrainedFemNodes& nodes, const std::vector<int>& vertices,
                                               Control& control) {
    const Newton compressible(newton.shared_tangent(), {newton.material().young_modulus, kCompressible}, 0.0,
                              newton.loads());
    NewtonWork work = compressible.make_work();
    const Eigen::VectorXd u = judged.solution.displacements.col(0), factors = judged.solution.factors.col(0);
    const NewtonState state = compressible.run(u, factors, kCompressibleTolerance, kCheckIterations, work, control);
    if (!state.converged) return {};
    std::optional<ReferenceAnswer> better =
        halved_answer(judged.mesh, compressible, vertices, judged.loads, state.u, factors, control);
    if (!better) return {};
    const auto reactions = [&](const Newton& by, const Eigen::VectorXd& at) {
        return present_reactions(nodes.shares, rows_of(at, nodes.vertices).col(0),
                                 rows_of(by.forces(at, factors, work, control), nodes.prescribed.nodes).col(0));
    };
    const Reactions own = reactions(newton, u), of_compressible = reactions(compressible, state.u);
    const double size = of_compressible.forces.norm(), share = size > 0.0 ? own.forces.norm() / size : 0.0;
    const Eigen::Index n = 3 * judged.mesh.n_vertices();
    better->displacements += u.head(n) - state.u.head(n);
    better->reactions.forces = own.forces + share * (better->reactions.forces - of_compressible.forces);
    better->reactions.moments = own.moments + share * (better->reactions.moments - of_compressible.moments);
    return better;
}

std::optional<ReferenceAnswer> halved(const JudgedAnswer& judged, const PinnedBody& body, Control& control) {
    const NonlinearMesh& mesh = judged.mesh;
    const ConstrainedFemNodes nodes = constrain_nodes(mesh.tets.vertices, mesh.midpoints, {}, body.vertices());
    const auto by = [&](const Newton& newton) {
        std::optional<ReferenceAnswer> better =
            halved_answer(mesh, newton, body.vertices(), judged.loads, judged.solution.displacements.col(0),
                          judged.solution.factors.col(0), control);
        if (!better && newton.material().poisson_ratio > kCompressible)
            better = by_compressible(judged, newton, nodes, body.vertices(), control);
        return better;
    };
    if (!body.is_pinned()) return by(judged.newton);
    return by(Newton(std::make_shared<const FreeTangent>(mesh.elements, nodes.prescribed.nodes, control),
                     judged.newton.material(), 0.0, judged.newton.loads()));
}

}  // namespace

std::optional<ReferenceAnswer> second_answer(const JudgedAnswer& judged, Control& control) {
    const NonlinearMesh& mesh = judged.mesh;
    const Material& material = judged.newton.material();
    const Eigen::VectorXd u = judged.solution.displacements.col(0);
    const Eigen::Index n = mesh.n_vertices();
    const PinnedBody body(mesh.tets.vertices.leftCols(n) + u.head(3 * n).reshaped(3, n), judged.vertices, judged.values,
                          u);
    if (!body.is_held()) return {};
    std::optional<ReferenceAnswer> second;
    if (mesh.linear) {
        if (judged.fits) second = halved(judged, body, control);
        if (!second && !judged.newton.loads().follow() && material.poisson_ratio <= kCompressible)
            second = linear_answer(mesh, material, body.vertices(), judged.loads, judged.solution, control);
    } else if (judged.fits) {
        second = ten_node_answer(mesh, material, body, judged.loads, judged.solution, control);
    }
    if (second) second = body.released(*std::move(second));
    return second;
}

}  // namespace elastolab
