// Ten-node tetrahedra by themselves: nodes, stiffness, exact fields, order, locking.
#include <gtest/gtest.h>

#include <cstdio>

#include <array>
#include <cmath>
#include <Eigen/Dense>
#include <set>

#include "base/lapack.hpp"
#include "elasticity/exact_fields.hpp"
#include "elasticity/rigid_motion.hpp"
#include "fem/fem_body.hpp"
#include "fem/prescribed.hpp"
#include "fem/quadratic_mesh.hpp"
#include "mesh/tets/boundary.hpp"

namespace elastolab {
namespace {

using test::make_tet_box;
using test::relative_error;

Material material_with(double nu) { return {.young_modulus = 2.0, .poisson_ratio = nu}; }

template <class Mesh>
SparseMatrix stiffness_of(const Mesh& mesh, const Material& material) {
    Control control;
    return stiffness(assemble_stiffness_parts(mesh, control), material);
}

/// Displacements of all nodes where the exact ones are prescribed at these.
Eigen::VectorXd solve(const SparseMatrix& K, const std::vector<int>& nodes, const Eigen::VectorXd& exact) {
    Control control;
    const Positions values = exact.reshaped(3, exact.size() / 3)(Eigen::all, nodes);
    return solve_prescribed(K, CholeskyAnalysis(K), nodes, values.reshaped(), control).displacements;
}

template <class Where>
std::vector<int> nodes_where(const Positions& positions, const Where& where) {
    return test::vertices_where(positions, static_cast<int>(positions.cols()), where);
}

/// Both ends along x; all of the surface.
std::vector<int> ends(const Positions& p, double length) {
    return nodes_where(p, [&](const Eigen::Vector3d& x) { return x[0] == 0.0 || x[0] == length; });
}
std::vector<int> outside(const Positions& p, const Eigen::Vector3d& size) {
    return nodes_where(
        p, [&](const Eigen::Vector3d& x) { return (x.array() == 0.0).any() || (x.array() == size.array()).any(); });
}

/// u_i = sum_jk c_ijk x_j x_k: a random one in equilibrium, (lambda + mu) grad div u + mu lap u = 0.
struct QuadraticField {
    std::array<Eigen::Matrix3d, 3> c;  // symmetric

    explicit QuadraticField(const Material& material) {
        for (Eigen::Matrix3d& ci : c) {
            const Eigen::Matrix3d random = Eigen::Matrix3d::Random();
            ci = random + random.transpose();
        }
        // Half of grad div u is sum_i c_i e_i, half of lap u_i the trace of c_i. Entry jj of c_i, j != i, appears in
        // the second only.
        const double a = material.lame_lambda() + material.shear_modulus(), mu = material.shear_modulus();
        Eigen::Vector3d grad_div = Eigen::Vector3d::Zero();
        for (int i = 0; i < 3; ++i) grad_div += c[static_cast<std::size_t>(i)].col(i);
        for (int i = 0; i < 3; ++i) {
            Eigen::Matrix3d& ci = c[static_cast<std::size_t>(i)];
            const int j = (i + 1) % 3;
            ci(j, j) -= (a * grad_div[i] + mu * ci.trace()) / mu;
        }
    }
    Eigen::Vector3d displacement(const Eigen::Vector3d& x) const {
        return {x.dot(c[0] * x), x.dot(c[1] * x), x.dot(c[2] * x)};
    }
    Eigen::Matrix3d gradient(const Eigen::Vector3d& x) const {
        Eigen::Matrix3d g;
        for (int i = 0; i < 3; ++i) g.row(i) = 2.0 * (c[static_cast<std::size_t>(i)] * x).transpose();
        return g;
    }
};

TEST(QuadraticMesh, NumbersTheSurfaceFirst) {
    const TetMesh mesh = make_tet_box({4, 3, 3}, {1.0, 1.2, 0.8}, 0.15);
    const SurfaceMesh surface = test::boundary(mesh);
    const QuadraticMesh quadratic(mesh);
    EXPECT_EQ(quadratic.n_surface_nodes, surface.n_vertices() + surface.n_triangles() * 3 / 2);
    EXPECT_EQ(quadratic.positions.leftCols(mesh.n_surface_vertices), mesh.vertices.leftCols(mesh.n_surface_vertices));
    const std::vector<int> on_surface = outside(quadratic.positions, {1.0, 1.2, 0.8});
    EXPECT_EQ(std::ssize(on_surface), quadratic.n_surface_nodes);
    EXPECT_EQ(on_surface.back(), quadratic.n_surface_nodes - 1);
    for (const auto& element : quadratic.elements.colwise())
        for (int e = 0; e < 6; ++e) {
            const Eigen::Vector3d ends =
                quadratic.positions.col(element[kTetEdges[e][0]]) + quadratic.positions.col(element[kTetEdges[e][1]]);
            EXPECT_LT((quadratic.positions.col(element[4 + e]) - 0.5 * ends).norm(), 1e-15);
        }
    const std::set<int> used(quadratic.elements.reshaped().begin(), quadratic.elements.reshaped().end());
    EXPECT_EQ(std::ssize(used), quadratic.n_nodes());
}

TEST(QuadraticMesh, SplitsIntoTetrahedraThatFillTheBody) {
    const QuadraticMesh quadratic(make_tet_box({3, 2, 2}, {1.0, 1.0, 1.0}, 0.15));
    const TetMesh split = quadratic.split();
    double sum = 0.0;
    for (const auto& t : split.tetrahedra.colwise()) {
        Eigen::Matrix3d edges;
        for (int i = 0; i < 3; ++i) edges.col(i) = split.vertices.col(t[i + 1]) - split.vertices.col(t[0]);
        EXPECT_GT(edges.determinant(), 0.0);
        sum += edges.determinant() / 6.0;
    }
    EXPECT_NEAR(sum, 1.0, 1e-13);
    EXPECT_EQ(boundary_triangles(split).cols(), 4 * quadratic.triangles.cols());
}

TEST(QuadraticFem, StiffnessIsExactlySymmetricWithSixNullModes) {
    const QuadraticMesh mesh(make_tet_box({2, 2, 1}, {1.0, 2.0, 0.5}, 0.15));
    const SparseMatrix K = stiffness_of(mesh, material_with(0.3));
    EXPECT_EQ((K - SparseMatrix(K.transpose())).norm(), 0.0);
    EXPECT_LT((K * rigid_modes(mesh.positions)).cwiseAbs().maxCoeff(), 1e-12 * K.coeffs().maxCoeff());
    const Eigen::VectorXd eigenvalues = symmetric_eigen(K).values;
    EXPECT_GT(eigenvalues[6], 1e-5 * eigenvalues[eigenvalues.size() - 1]) << "a seventh null mode";
}

TEST(QuadraticFem, HasTheEnergyOfAQuadraticField) {
    // Against Gauss's product rule on the box, exact for the energy density, which is of degree 2.
    const Eigen::Vector3d size(1.0, 1.2, 0.8);
    const QuadraticMesh mesh(make_tet_box({3, 3, 2}, size, 0.15));
    const Material material = material_with(0.3);
    const double lambda = material.lame_lambda(), mu = material.shear_modulus();
    const QuadraticField field(material_with(0.1));
    double energy = 0.0;
    for (int point = 0; point < 8; ++point) {
        Eigen::Vector3d x;
        for (int i = 0; i < 3; ++i) x[i] = size[i] * (0.5 + ((point >> i) % 2 == 0 ? -1.0 : 1.0) / std::sqrt(12.0));
        const Eigen::Matrix3d g = field.gradient(x), strain = 0.5 * (g + g.transpose());
        energy += size.prod() / 8.0 * (0.5 * lambda * std::pow(strain.trace(), 2) + mu * strain.squaredNorm());
    }
    const Eigen::VectorXd u = displacements(field, mesh.positions);
    EXPECT_NEAR(0.5 * u.dot(stiffness_of(mesh, material) * u), energy, 1e-12 * energy);
}

TEST(QuadraticFem, ReproducesEveryQuadraticFieldInEquilibrium) {
    const Eigen::Vector3d size(2.0, 1.0, 1.0);
    const QuadraticMesh mesh(make_tet_box({3, 3, 3}, size, 0.15));
    for (const double nu : {-0.3, 0.0, 0.3, 0.49}) {
        const SparseMatrix K = stiffness_of(mesh, material_with(nu));
        for (int round = 0; round < 3; ++round) {
            const Eigen::VectorXd exact = displacements(QuadraticField(material_with(nu)), mesh.positions);
            EXPECT_LT(relative_error(solve(K, outside(mesh.positions, size), exact), exact), 1e-11) << nu;
        }
    }
}

TEST(QuadraticFem, StretchesAndBendsABoxExactly) {
    const QuadraticMesh mesh(make_tet_box({3, 2, 2}, {2.0, 1.0, 1.0}, 0.15));
    for (const double nu : {0.0, 0.3, 0.49}) {
        const Material material = material_with(nu);
        const SparseMatrix K = stiffness_of(mesh, material);
        for (const Eigen::VectorXd& exact : {displacements(UniaxialStretch{material}, mesh.positions),
                                             displacements(PureBending{material}, mesh.positions)})
            EXPECT_LT(relative_error(solve(K, ends(mesh.positions, 2.0), exact), exact), 1e-11) << nu;
    }
}

/// rms error on a cube all of whose surface is prescribed by a field that no polynomial is.
template <class Mesh>
double point_force_error(const Mesh& mesh, const Positions& nodes, double nu) {
    const PointForceField field{material_with(nu), {-0.4, 0.5, 0.6}, {1.0, 2.0, -1.0}};
    const Eigen::VectorXd exact = displacements(field, nodes);
    const SparseMatrix K = stiffness_of(mesh, field.material);
    return (solve(K, outside(nodes, Eigen::Vector3d::Ones()), exact) - exact).norm() / exact.norm();
}

double point_force_error(int cells, double nu) {
    const QuadraticMesh mesh(make_tet_box({cells, cells, cells}, {1.0, 1.0, 1.0}, 0.1));
    return point_force_error(mesh, mesh.positions, nu);
}

TEST(QuadraticFem, ConvergesWithThirdOrder) {
    const double coarse = point_force_error(4, 0.3), fine = point_force_error(8, 0.3);
    EXPECT_GT(std::log2(coarse / fine), 0.9 * 3.0) << coarse << " " << fine;
}

TEST(QuadraticFem, DoesNotLockWhereLinearElementsDo) {
    // Near 1/2 they lose accuracy, too, but go on converging, and stay far below linear ones of as many unknowns.
    const TetMesh linear = make_tet_box({8, 8, 8}, {1.0, 1.0, 1.0}, 0.1);
    for (const double nu : {0.3, 0.49}) {
        const double coarse = point_force_error(2, nu), fine = point_force_error(4, nu);
        const double of_linear = point_force_error(linear, linear.vertices, nu);
        std::printf("[ measured ] nu %g: quadratic 2 and 4 cells %.3g %.3g, linear 8 cells %.3g\n", nu, coarse, fine,
                    of_linear);
        EXPECT_GT(std::log2(coarse / fine), 1.5) << nu;
        EXPECT_LT(fine, 0.6 * of_linear) << nu;
    }
}

}  // namespace
}  // namespace elastolab
