#include "fem/error_estimate.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <Eigen/LU>
#include <utility>
#include <vector>

#include "base/memory.hpp"
#include "deform/conjugate_gradients.hpp"
#include "deform/node_rows.hpp"
#include "deform/pinned_body.hpp"
#include "fem/constrained_nodes.hpp"
#include "fem/constraints.hpp"
#include "fem/load_vectors.hpp"
#include "fem/stiffness_product.hpp"

namespace elastolab {

namespace {

/// Of what the second answer changes, in energy: two digits are enough for an estimate where the first is the worse by
/// far, less where it is the answer's own kind.
constexpr double kEnoughOfLinear = 0.01, kEnoughOfHalved = 0.03;
constexpr int kMostIterations = 150;
/// Bytes of elements, their interpolation and vectors for each quadratic node; and for each node of quadratic elements
/// that are halved, where there are eight in place of it.
constexpr std::uint64_t kBytesOfQuadraticNode = 1500, kBytesOfHalvedNode = 14000;

/// Expresses the nodes of quadratic elements by the corners of their tetrahedra: a corner is itself, a midpoint the
/// mean of its ends.
class CornerNodes {
public:
    /// elements: corners, then midpoints by kTetEdges.
    CornerNodes(const Eigen::Matrix<int, 10, Eigen::Dynamic>& elements, int n_nodes)
        : ends_(static_cast<std::size_t>(n_nodes), {-1, -1}), corner_(static_cast<std::size_t>(n_nodes), -1) {
        for (const auto& element : elements.colwise())
            for (int e = 0; e < 6; ++e)
                ends_[static_cast<std::size_t>(element[4 + e])] = {element[kTetEdges[e][0]], element[kTetEdges[e][1]]};
        for (int node = 0; node < n_nodes; ++node)
            if (!is_midpoint(node)) corner_[static_cast<std::size_t>(node)] = n_corners_++;
    }
    int n_corners() const { return n_corners_; }
    bool is_midpoint(int node) const { return ends_[static_cast<std::size_t>(node)][0] >= 0; }

    /// 3*n_nodes x 3*n_corners; corners keep their order.
    SparseMatrix prolongation() const {
        std::vector<Eigen::Triplet<double>> entries;
        for (int node = 0; node < static_cast<int>(ends_.size()); ++node)
            for (int axis = 0; axis < 3; ++axis) {
                const auto add = [&](int corner_node, double weight) {
                    entries.emplace_back(3 * node + axis, 3 * corner_[static_cast<std::size_t>(corner_node)] + axis,
                                         weight);
                };
                if (!is_midpoint(node)) add(node, 1.0);
                for (const int end : ends_[static_cast<std::size_t>(node)])
                    if (end >= 0) add(end, 0.5);
            }
        SparseMatrix P(3 * std::ssize(ends_), 3 * n_corners_);
        P.setFromTriplets(entries.begin(), entries.end());
        return P;
    }

private:
    std::vector<std::array<int, 2>> ends_;
    std::vector<int> corner_;
    int n_corners_ = 0;
};

Eigen::VectorXd with_zeros(Eigen::VectorXd all, const std::vector<char>& is_prescribed) {
    for (std::size_t node = 0; node < is_prescribed.size(); ++node)
        if (is_prescribed[node]) all.segment<3>(3 * static_cast<Eigen::Index>(node)).setZero();
    return all;
}

/// The quadratic stiffness between the nodes that are not prescribed; zero for the others.
class FreeStiffness : public LinearOperator {
public:
    FreeStiffness(const ReferenceOperators::Product& K, const std::vector<char>& is_prescribed)
        : K_(K), is_prescribed_(is_prescribed) {}
    Eigen::Index size() const override { return 3 * std::ssize(is_prescribed_); }
    Eigen::MatrixXd product(const Eigen::MatrixXd& X) const override {
        Eigen::MatrixXd Y(X.rows(), X.cols());
        for (Eigen::Index c = 0; c < X.cols(); ++c) Y.col(c) = with_zeros(K_(X.col(c)), is_prescribed_);
        return Y;
    }

private:
    const ReferenceOperators::Product& K_;
    const std::vector<char>& is_prescribed_;
};

/// Corrects a vector of all nodes by both levels.
class TwoLevelPreconditioner : public LinearOperator {
public:
    TwoLevelPreconditioner(const ReferenceOperators& apply, const CornerNodes& corners,
                           const SparseMatrix& prolongation, const std::vector<char>& is_prescribed)
        : apply_(apply), prolongation_(prolongation), is_prescribed_(is_prescribed) {
        for (int node = 0; node < static_cast<int>(is_prescribed_.size()); ++node) {
            Eigen::Matrix3d block = Eigen::Matrix3d::Zero();
            if (corners.is_midpoint(node) && !is_prescribed_[static_cast<std::size_t>(node)])
                block = apply_.diagonal(node).inverse();
            of_midpoints_.push_back(block);
        }
    }
    Eigen::Index size() const override { return 3 * std::ssize(is_prescribed_); }
    Eigen::MatrixXd product(const Eigen::MatrixXd& R) const override {
        Eigen::MatrixXd Z(R.rows(), R.cols());
        for (Eigen::Index c = 0; c < R.cols(); ++c) Z.col(c) = corrected(R.col(c));
        return Z;
    }

private:
    Eigen::VectorXd corrected(const Eigen::VectorXd& residual) const {
        const Eigen::VectorXd on_corners = prolongation_.transpose() * residual;
        Eigen::VectorXd z = prolongation_ * apply_.solve_linear(on_corners);
        for (std::size_t node = 0; node < of_midpoints_.size(); ++node)
            z.segment<3>(3 * static_cast<Eigen::Index>(node)) +=
                of_midpoints_[node] * residual.segment<3>(3 * static_cast<Eigen::Index>(node));
        return with_zeros(std::move(z), is_prescribed_);
    }

    const ReferenceOperators& apply_;
    const SparseMatrix& prolongation_;
    const std::vector<char>& is_prescribed_;
    std::vector<Eigen::Matrix3d> of_midpoints_;
};

/// Values of the coarse nodes at those of quadratic elements that halve them. elements: the coarse ones, 10 rows.
SparseMatrix interpolation(const QuadraticMesh& halved, const Eigen::MatrixXi& elements) {
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<char> seen(static_cast<std::size_t>(halved.n_nodes()), 0);
    for (Eigen::Index t = 0; t < halved.elements.cols(); ++t)
        for (int i = 0; i < 10; ++i) {
            const int node = halved.elements(i, t);
            if (std::exchange(seen[static_cast<std::size_t>(node)], 1) != 0) continue;
            const Eigen::Vector4d at = in_whole(static_cast<int>(t % 8), node_coordinates(i));
            const Eigen::Matrix<double, 10, 1> shapes = quadratic_shapes(at);
            for (int k = 0; k < 10; ++k)
                for (int axis = 0; axis < 3 && shapes[k] != 0.0; ++axis)
                    entries.emplace_back(3 * node + axis, 3 * elements(k, t / 8) + axis, shapes[k]);
        }
    SparseMatrix P(3 * halved.n_nodes(), 3 * (elements.maxCoeff() + 1));
    P.setFromTriplets(entries.begin(), entries.end());
    return P;
}

/// Four triangles in place of each.
Triangles quarters(const Triangles& triangles, const Triangles& midpoints) {
    Triangles fine(3, 4 * triangles.cols());
    for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
        const Eigen::Vector3i v = triangles.col(t), m = midpoints.col(t);
        fine.middleCols<4>(4 * t) << v[0], m[0], m[2], m[0],  //
            m[0], v[1], m[1], m[1],                           //
            m[2], m[1], v[2], m[2];
    }
    return fine;
}

/// The same loads on these.
std::vector<UnitLoad> on_quarters(std::span<const UnitLoad> loads) {
    std::vector<UnitLoad> fine(loads.begin(), loads.end());
    for (UnitLoad& load : fine) {
        const std::vector<int> whole = std::exchange(load.triangles, {});
        load.tractions = load.tractions.replicate<4, 1>().reshaped(3, 4 * std::ssize(whole)).eval();
        for (const int t : whole)
            for (int k = 0; k < 4; ++k) load.triangles.push_back(4 * t + k);
    }
    return fine;
}

/// Each vertex with its part of what the nodes around it carry, whose displacements follow its own.
Reactions at_vertices(const Reactions& at_nodes, const ConstrainedFemNodes& nodes) {
    const Eigen::Index n = std::ssize(nodes.vertices);
    Reactions sums{Eigen::Matrix3Xd::Zero(3, n), Eigen::Matrix3Xd::Zero(3, n)};
    for (const LoadShare& share : nodes.shares) {
        sums.forces.col(share.constrained) += share.weight * at_nodes.forces.col(share.slot);
        sums.moments.col(share.constrained) += share.weight * at_nodes.moments.col(share.slot);
    }
    return sums;
}

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
    std::vector<char> is_prescribed(static_cast<std::size_t>(mesh.n_nodes()), 0);
    for (const int node : constrained.prescribed.nodes) is_prescribed[static_cast<std::size_t>(node)] = 1;

    Eigen::VectorXd u = Eigen::VectorXd::Zero(problem.prolongation.cols());
    for (std::size_t i = 0; i < problem.vertices.size(); ++i)
        u.segment<3>(3 * problem.vertices[i]) = problem.values.segment<3>(3 * static_cast<Eigen::Index>(i));
    Eigen::VectorXd load = problem.coarse_given - apply.linear(u);
    for (const int v : problem.vertices) load.segment<3>(3 * v).setZero();
    control.checkpoint();
    u += apply.solve_linear(load);
    u = (problem.prolongation * u).eval();
    u += conjugate_gradients(
        FreeStiffness(apply.quadratic, is_prescribed),
        TwoLevelPreconditioner(apply, CornerNodes(mesh.elements, mesh.n_nodes()), problem.prolongation, is_prescribed),
        with_zeros(problem.given - apply.quadratic(u), is_prescribed),
        {.energy_tolerance = problem.enough, .max_iterations = kMostIterations, .must_converge = false},
        "stiffness matrix of quadratic elements", control);
    return {u, reactions_of(apply.quadratic(u), problem.given, constrained, problem.vertices.size())};
}

}  // namespace

/// Nodes of quadratic elements by Euler's formula: vertices - edges + faces - tetrahedra = 1 for a ball.
std::uint64_t quadratic_reference_memory(const FemSystem& linear) {
    const TetMesh& tets = linear.mesh->tets;
    const std::int64_t n_edges = tets.n_vertices() + tets.n_tetrahedra() + tets.n_surface_vertices;
    return kBytesOfQuadraticNode * static_cast<std::uint64_t>(tets.n_vertices() + n_edges);
}

std::uint64_t halved_reference_memory(const FemSystem& quadratic, bool has_factor) {
    const std::uint64_t factor =
        quadratic.mesh->analysis->factor_bytes() + 12 * static_cast<std::uint64_t>(quadratic.K.nonZeros());
    return (has_factor ? 0 : factor) +
           kBytesOfHalvedNode * static_cast<std::uint64_t>(quadratic.mesh->tets.n_vertices());
}

std::optional<ReferenceAnswer> quadratic_reference(const FemSystem& linear, double poisson_ratio,
                                                   std::span<const int> vertices, std::span<const UnitLoad> loads,
                                                   const Eigen::VectorXd& values, const Eigen::VectorXd& first,
                                                   const Factor& held, Control& control) {
    const PinnedBody body(linear.positions().leftCols(linear.n_vertices()), vertices, values, first);
    if (!body.is_held()) return {};
    control.checkpoint();
    const QuadraticMesh mesh(linear.mesh->tets);
    if (quadratic_reference_memory(linear) > available_memory_bytes()) return {};
    const StiffnessProduct stiffness(mesh, Material{1.0, poisson_ratio});
    const Eigen::Matrix3Xd diagonal = stiffness.diagonal();
    const Factor factor = factor_for(body, linear, body.vertices(), held, control);
    ReferenceOperators apply;
    apply.linear = [&](const Eigen::VectorXd& u) -> Eigen::VectorXd { return linear.K * u; };
    apply.quadratic = [&](const Eigen::VectorXd& u) -> Eigen::VectorXd { return stiffness(u); };
    apply.solve_linear = [&](const Eigen::VectorXd& f) -> Eigen::VectorXd { return factor->solve(f).col(0); };
    apply.diagonal = [&](int node) -> Eigen::Matrix3d { return diagonal.middleCols<3>(3 * node); };
    return body.released(
        quadratic_reference(mesh, *linear.mesh, apply, body.vertices(), loads, body.values(), control));
}

ReferenceAnswer quadratic_reference(const QuadraticMesh& mesh, const FemMesh& linear, const ReferenceOperators& apply,
                                    std::span<const int> vertices, std::span<const UnitLoad> loads,
                                    const Eigen::VectorXd& values, Control& control) {
    const Eigen::VectorXd factors = values.tail(std::ssize(loads));
    const NodalAnswer fine =
        answer_by_levels({.mesh = mesh,
                          .prolongation = CornerNodes(mesh.elements, mesh.n_nodes()).prolongation(),
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
    if (!body.is_held() || halved_reference_memory(quadratic, held && !body.is_pinned()) > available_memory_bytes())
        return {};
    const FemMesh& coarse = *quadratic.mesh;
    TetMesh tets = coarse.tets;
    tets.n_surface_vertices = coarse.n_surface_nodes;
    const QuadraticMesh mesh(tets);
    const StiffnessProduct stiffness(mesh, Material{1.0, poisson_ratio});
    const Eigen::Matrix3Xd diagonal = stiffness.diagonal();
    const ConstrainedFemNodes nodes = constrain_nodes(quadratic.positions(), coarse.midpoints, {}, body.vertices());
    const Factor factor = factor_for(body, quadratic, nodes.prescribed.nodes, held, control);
    ReferenceOperators apply;
    apply.linear = [&](const Eigen::VectorXd& u) -> Eigen::VectorXd { return quadratic.K * u; };
    apply.quadratic = [&](const Eigen::VectorXd& u) -> Eigen::VectorXd { return stiffness(u); };
    apply.solve_linear = [&](const Eigen::VectorXd& f) -> Eigen::VectorXd { return factor->solve(f).col(0); };
    apply.diagonal = [&](int node) -> Eigen::Matrix3d { return diagonal.middleCols<3>(3 * node); };
    const Eigen::VectorXd factors = values.tail(std::ssize(loads));
    const NodalAnswer fine = answer_by_levels(
        {.mesh = mesh,
         .prolongation = interpolation(mesh, coarse.elements()),
         .vertices = nodes.prescribed.nodes,
         .values = nodes.prescribed.prescribe * body.values().head(3 * std::ssize(body.vertices())),
         .coarse_given = load_vectors(coarse, loads) * factors,
         .given = load_vectors(mesh, quarters(coarse.surface, coarse.surface_midpoints), on_quarters(loads)) * factors,
         .enough = kEnoughOfHalved},
        apply, control);
    return body.released({fine.displacements.head(3 * quadratic.n_vertices()), at_vertices(fine.reactions, nodes),
                          1.0 + kLeftByHalving});
}

}  // namespace elastolab
