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
#include "fem/prescribed.hpp"

namespace elastolab {

namespace {

/// An estimate needs no more than two digits in energy.
const IterationOptions kEnough{.energy_tolerance = 0.01, .max_iterations = 150, .must_converge = false};
/// Bytes of the stiffness and its parts for each quadratic node, some 30 blocks of 3 x 3 in each of three matrices; and
/// of the linear stiffness and its factor, by which quadratic elements are judged, for each of their nodes.
constexpr std::uint64_t kBytesOfQuadraticNode = 9000, kBytesOfLinearPart = 3000;

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

/// forces: of all nodes, the given ones among them.
Reactions reactions_of(const Eigen::VectorXd& forces, const Eigen::VectorXd& given,
                       const ConstrainedFemNodes& constrained, std::size_t n_vertices) {
    return gathered_reactions(constrained.shares, static_cast<int>(n_vertices),
                              rows_of(forces - given, constrained.prescribed.nodes).col(0));
}

}  // namespace

/// Nodes of quadratic elements by Euler's formula: vertices - edges + faces - tetrahedra = 1 for a ball.
std::uint64_t quadratic_reference_memory(const FemSystem& linear) {
    const TetMesh& tets = linear.mesh->tets;
    const std::int64_t n_edges = tets.n_vertices() + tets.n_tetrahedra() + tets.n_surface_vertices;
    return kBytesOfQuadraticNode * static_cast<std::uint64_t>(tets.n_vertices() + n_edges);
}

std::uint64_t linear_reference_memory(const FemSystem& quadratic) {
    return kBytesOfLinearPart * static_cast<std::uint64_t>(quadratic.mesh->tets.n_vertices());
}

std::optional<ReferenceAnswer> quadratic_reference(const FemSystem& linear, double poisson_ratio,
                                                   std::span<const int> vertices, std::span<const UnitLoad> loads,
                                                   const Eigen::VectorXd& values, const Eigen::VectorXd& first,
                                                   Control& control) {
    const PinnedBody body(linear.positions().leftCols(linear.n_vertices()), vertices, values, first);
    if (!body.is_held()) return {};
    control.checkpoint();
    const QuadraticMesh mesh(linear.mesh->tets);
    if (quadratic_reference_memory(linear) > available_memory_bytes()) return {};
    const SparseMatrix K = stiffness(assemble_stiffness_parts(mesh, control), Material{1.0, poisson_ratio});
    const SparseCholesky coarse(*linear.mesh->analysis, eliminated(linear.K, body.vertices()), "stiffness matrix",
                                &control);
    ReferenceOperators apply;
    apply.linear = [&](const Eigen::VectorXd& u) -> Eigen::VectorXd { return linear.K * u; };
    apply.quadratic = [&](const Eigen::VectorXd& u) -> Eigen::VectorXd { return K * u; };
    apply.solve_linear = [&](const Eigen::VectorXd& f) -> Eigen::VectorXd { return coarse.solve(f).col(0); };
    apply.diagonal = [&](int node) -> Eigen::Matrix3d { return K.block(3 * node, 3 * node, 3, 3); };
    return body.released(
        quadratic_reference(mesh, *linear.mesh, apply, body.vertices(), loads, body.values(), control));
}

ReferenceAnswer quadratic_reference(const QuadraticMesh& mesh, const FemMesh& linear, const ReferenceOperators& apply,
                                    std::span<const int> vertices, std::span<const UnitLoad> loads,
                                    const Eigen::VectorXd& values, Control& control) {
    const CornerNodes corners(mesh.elements, mesh.n_nodes());
    const SparseMatrix prolongation = corners.prolongation();
    const ConstrainedFemNodes constrained =
        constrain_nodes(mesh.positions, {mesh.triangles, mesh.midpoints}, {}, vertices);
    std::vector<char> is_prescribed(static_cast<std::size_t>(mesh.n_nodes()), 0);
    for (const int node : constrained.prescribed.nodes) is_prescribed[static_cast<std::size_t>(node)] = 1;

    Eigen::VectorXd u = Eigen::VectorXd::Zero(linear.tets.vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i)
        u.segment<3>(3 * vertices[i]) = values.segment<3>(3 * static_cast<Eigen::Index>(i));
    const Eigen::VectorXd factors = values.tail(std::ssize(loads));
    const Eigen::VectorXd given = load_vectors(mesh, linear, loads) * factors;
    Eigen::VectorXd load = load_vectors(linear, loads) * factors - apply.linear(u);
    for (const int v : vertices) load.segment<3>(3 * v).setZero();
    control.checkpoint();
    u += apply.solve_linear(load);
    u = (prolongation * u).eval();
    u += conjugate_gradients(FreeStiffness(apply.quadratic, is_prescribed),
                             TwoLevelPreconditioner(apply, corners, prolongation, is_prescribed),
                             with_zeros(given - apply.quadratic(u), is_prescribed), kEnough,
                             "stiffness matrix of quadratic elements", control);
    return ReferenceAnswer{u.head(3 * linear.tets.n_surface_vertices),
                           reactions_of(apply.quadratic(u), given, constrained, vertices.size()),
                           1.0 + kLeftByQuadratic};
}

std::optional<ReferenceAnswer> linear_reference(const FemSystem& quadratic, std::span<const int> vertices,
                                                std::span<const UnitLoad> loads, const Eigen::VectorXd& values,
                                                const Eigen::VectorXd& first, Control& control) {
    const PinnedBody body(quadratic.positions().leftCols(quadratic.n_vertices()), vertices, values, first);
    if (!body.is_held()) return {};
    const std::vector<int>& held = body.vertices();
    const CornerNodes corners(rejoined(quadratic.mesh->tets), quadratic.mesh->tets.n_vertices());
    const SparseMatrix prolongation = corners.prolongation();
    const SparseMatrix K = SparseMatrix(prolongation.transpose()) * (quadratic.K * prolongation);
    control.checkpoint();
    const Eigen::MatrixXd given =
        prolongation.transpose() * (load_vectors(*quadratic.mesh, loads) * values.tail(std::ssize(loads)));
    const PrescribedSolution solution =
        solve_prescribed(K, CholeskyAnalysis(K), held, body.values().head(3 * std::ssize(held)), control, given);
    const std::vector<LoadShare> shares = nodal_shares(quadratic.positions(), held);
    return body.released({solution.displacements.col(0).head(3 * quadratic.n_vertices()),
                          gathered_reactions(shares, static_cast<int>(held.size()), solution.forces.col(0)),
                          -kLeftByQuadratic});
}

}  // namespace elastolab
