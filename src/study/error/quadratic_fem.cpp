#include "study/error/quadratic_fem.hpp"

#include <algorithm>
#include <Eigen/Dense>

#include "fem/constraints.hpp"
#include "fem/sparse_cholesky.hpp"

namespace elastolab {

namespace {

constexpr int kEdges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

using Gradients = Eigen::Matrix<double, 3, 10>;

/// Gradients of the ten shape functions L_a (2 L_a - 1) and 4 L_a L_b at barycentric coordinates L, whose gradients
/// are the columns of dL.
Gradients shape_gradients(const Eigen::Matrix<double, 3, 4>& dL, const Eigen::Vector4d& L) {
    Gradients g;
    for (int a = 0; a < 4; ++a) g.col(a) = (4.0 * L[a] - 1.0) * dL.col(a);
    for (int e = 0; e < 6; ++e) {
        const int a = kEdges[e][0], b = kEdges[e][1];
        g.col(4 + e) = 4.0 * (L[a] * dL.col(b) + L[b] * dL.col(a));
    }
    return g;
}

Eigen::Matrix<double, 30, 30> element_stiffness(const Eigen::Matrix<double, 3, 4>& corners, const Material& material) {
    // Gauss's rule of degree 2 on a tetrahedron: (5 + 3 sqrt 5) / 20 and thrice (5 - sqrt 5) / 20.
    constexpr double kNearCorner = 0.58541019662496852, kOthers = 0.13819660112501050;
    Eigen::Matrix4d system;
    system << Eigen::RowVector4d::Ones(), corners;
    const Eigen::Matrix<double, 3, 4> dL = system.inverse().rightCols<3>().transpose();
    const double volume = system.determinant() / 6.0;
    const double lambda = material.lame_lambda(), mu = material.shear_modulus();
    Eigen::Matrix<double, 30, 30> k = Eigen::Matrix<double, 30, 30>::Zero();
    for (int point = 0; point < 4; ++point) {
        Eigen::Vector4d L = Eigen::Vector4d::Constant(kOthers);
        L[point] = kNearCorner;
        const Gradients g = shape_gradients(dL, L);
        for (int a = 0; a < 10; ++a)
            for (int b = 0; b < 10; ++b) {
                const Eigen::Matrix3d outer = g.col(a) * g.col(b).transpose();
                k.block<3, 3>(3 * a, 3 * b) +=
                    volume / 4.0 *
                    (lambda * outer + mu * outer.transpose() + mu * outer.trace() * Eigen::Matrix3d::Identity());
            }
    }
    return k;
}

/// Nodes that share an element, ascending, for every node.
std::vector<std::vector<int>> adjacency(const QuadraticMesh& mesh) {
    std::vector<std::vector<int>> lists(static_cast<std::size_t>(mesh.n_nodes()));
    for (const auto& element : mesh.elements.colwise())
        for (int a : element) {
            std::vector<int>& list = lists[static_cast<std::size_t>(a)];
            list.insert(list.end(), element.begin(), element.end());
        }
    for (std::vector<int>& list : lists) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    return lists;
}

SparseMatrix zero_matrix(const std::vector<std::vector<int>>& lists) {
    SparseMatrix K(3 * std::ssize(lists), 3 * std::ssize(lists));
    std::size_t n_blocks = 0;
    for (const auto& list : lists) n_blocks += list.size();
    K.reserve(static_cast<Eigen::Index>(9 * n_blocks));
    for (int column = 0; column < K.cols(); ++column) {
        K.startVec(column);
        for (int node : lists[static_cast<std::size_t>(column / 3)])
            for (int i = 0; i < 3; ++i) K.insertBack(3 * node + i, column) = 0.0;
    }
    K.finalize();
    return K;
}

}  // namespace

QuadraticMesh::QuadraticMesh(const TetMesh& mesh) {
    elements.resize(10, mesh.n_tetrahedra());
    elements.topRows<4>() = mesh.tetrahedra;
    for (Eigen::Index t = 0; t < elements.cols(); ++t)
        for (int e = 0; e < 6; ++e) {
            const int a = elements(kEdges[e][0], t), b = elements(kEdges[e][1], t);
            const int next = mesh.n_vertices() + static_cast<int>(edges.size());
            elements(4 + e, t) = edges.try_emplace({std::min(a, b), std::max(a, b)}, next).first->second;
        }
    positions.resize(3, mesh.n_vertices() + std::ssize(edges));
    positions.leftCols(mesh.n_vertices()) = mesh.vertices;
    for (const auto& [edge, node] : edges)
        positions.col(node) = 0.5 * (mesh.vertices.col(edge[0]) + mesh.vertices.col(edge[1]));
}

SparseMatrix quadratic_stiffness(const QuadraticMesh& mesh, const Material& material) {
    const std::vector<std::vector<int>> lists = adjacency(mesh);
    SparseMatrix K = zero_matrix(lists);
    for (const auto& element : mesh.elements.colwise()) {
        const Eigen::Matrix<double, 3, 4> corners = mesh.positions(Eigen::all, element.head<4>());
        const Eigen::Matrix<double, 30, 30> k = element_stiffness(corners, material);
        for (int b = 0; b < 10; ++b) {
            const std::vector<int>& list = lists[static_cast<std::size_t>(element[b])];
            for (int a = 0; a < 10; ++a) {
                const auto place = std::lower_bound(list.begin(), list.end(), element[a]) - list.begin();
                for (int j = 0; j < 3; ++j)
                    for (int i = 0; i < 3; ++i)
                        K.valuePtr()[K.outerIndexPtr()[3 * element[b] + j] + 3 * place + i] += k(3 * a + i, 3 * b + j);
            }
        }
    }
    return K;
}

Positions solve_quadratic(const QuadraticMesh& mesh, const Material& material, std::span<const int> nodes,
                          const Positions& values) {
    const SparseMatrix K = quadratic_stiffness(mesh, material);
    Positions u = Positions::Zero(3, mesh.n_nodes());
    u(Eigen::all, nodes) = values;
    Eigen::VectorXd load = -(K * u.reshaped());
    for (int node : nodes) load.segment<3>(3 * node).setZero();
    u += SparseCholesky(CholeskyAnalysis(K), eliminated(K, nodes), "truth").solve(load).reshaped(3, mesh.n_nodes());
    return u;
}

}  // namespace elastolab
