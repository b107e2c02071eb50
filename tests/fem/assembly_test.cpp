#include "fem/assembly.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "base/blas.hpp"
#include "base/error.hpp"
#include "base/lapack.hpp"
#include "elasticity/rigid_motion.hpp"
#include "support/tet_box.hpp"

namespace elastolab {
namespace {

const Material kMaterial{.young_modulus = 2.0, .poisson_ratio = 0.3};

/// The textbook way, dense: B^T C B V in Voigt notation (engineering shear strains), shape functions by inverting the
/// 4 x 4 matrix of (1, x, y, z). Shares nothing with the code under test.
Eigen::MatrixXd textbook_stiffness(const TetMesh& mesh, const Material& material) {
    const double nu = material.poisson_ratio;
    const double factor = material.young_modulus / ((1.0 + nu) * (1.0 - 2.0 * nu));
    Eigen::MatrixXd C = Eigen::MatrixXd::Zero(6, 6);
    C.topLeftCorner<3, 3>().setConstant(factor * nu);
    C.topLeftCorner<3, 3>().diagonal().setConstant(factor * (1.0 - nu));
    C.bottomRightCorner<3, 3>().diagonal().setConstant(factor * (1.0 - 2.0 * nu) / 2.0);
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(mesh.vertices.size(), mesh.vertices.size());
    for (const auto& tet : mesh.tetrahedra.colwise()) {
        Eigen::Matrix4d corners;
        for (int a = 0; a < 4; ++a) corners.row(a) << 1.0, mesh.vertices.col(tet[a]).transpose();
        const Eigen::Matrix4d coefficients = corners.inverse();  // column a: N_a = c0 + c1 x + c2 y + c3 z
        Eigen::MatrixXd B = Eigen::MatrixXd::Zero(6, 12);
        for (int a = 0; a < 4; ++a) {
            const double x = coefficients(1, a), y = coefficients(2, a), z = coefficients(3, a);
            B.middleCols<3>(3 * a) << x, 0, 0, 0, y, 0, 0, 0, z, y, x, 0, 0, z, y, z, 0, x;
        }
        const Eigen::MatrixXd stress = C * B, k = corners.determinant() / 6.0 * (B.transpose() * stress);
        for (int a = 0; a < 4; ++a)
            for (int b = 0; b < 4; ++b) K.block<3, 3>(3 * tet[a], 3 * tet[b]) += k.block<3, 3>(3 * a, 3 * b);
    }
    return K;
}

SparseMatrix stiffness_of(const TetMesh& mesh, const Material& material = kMaterial) {
    Control control;
    return stiffness(assemble_stiffness_parts(mesh, control), material);
}

TEST(Assembly, AgreesWithTheTextbookForAnyPoissonRatio) {
    const TetMesh mesh = test::make_tet_box({3, 4, 2}, {1.0, 1.5, 0.7}, 0.15);
    for (double nu : {-0.5, 0.0, 0.3, 0.4999}) {
        const Material material{.young_modulus = 3.0, .poisson_ratio = nu};
        const Eigen::MatrixXd expected = textbook_stiffness(mesh, material);
        const double error = (Eigen::MatrixXd(stiffness_of(mesh, material)) - expected).cwiseAbs().maxCoeff();
        EXPECT_LT(error, 1e-13 * expected.cwiseAbs().maxCoeff()) << "nu = " << nu;
    }
}

TEST(Assembly, IsExactlySymmetric) {
    const SparseMatrix K = stiffness_of(test::make_tet_box({4, 3, 3}, {1.0, 1.0, 1.0}, 0.15));
    EXPECT_EQ((K - SparseMatrix(K.transpose())).norm(), 0.0);
}

TEST(Assembly, HasSixRigidNullModes) {
    for (double jitter : {0.0, 0.15}) {
        const TetMesh mesh = test::make_tet_box({4, 3, 3}, {1.0, 2.0, 0.5}, jitter);
        const SparseMatrix K = stiffness_of(mesh);
        const Eigen::MatrixXd R = rigid_modes(mesh.vertices);
        EXPECT_LT((K * R).cwiseAbs().maxCoeff(), 1e-12 * K.coeffs().maxCoeff());
        const Eigen::VectorXd eigenvalues = symmetric_eigen(K).values;
        EXPECT_GT(eigenvalues[6], 1e-6 * eigenvalues[eigenvalues.size() - 1]) << "a seventh null mode";
    }
}

TEST(Assembly, DoesNotDependOnTheNumberOfThreads) {
    const TetMesh mesh = test::make_tet_box({12, 12, 6}, {1.0, 1.0, 0.5}, 0.1);
    const int threads = thread_count();
    set_thread_count(1);
    const SparseMatrix one = stiffness_of(mesh);
    set_thread_count(3);
    const SparseMatrix three = stiffness_of(mesh);
    set_thread_count(threads);
    EXPECT_EQ((one - three).norm(), 0.0);
}

TEST(Assembly, RefusesAFlatTetrahedron) {
    TetMesh mesh = test::make_tet_box({1, 1, 1}, {1.0, 1.0, 1.0});
    mesh.vertices.row(2).setZero();
    EXPECT_THROW(stiffness_of(mesh), MeshError);
}

TEST(Assembly, StopsWhenCancelled) {
    Control control;
    control.cancel();
    EXPECT_THROW(assemble_stiffness_parts(test::make_tet_box({2, 2, 2}, {1.0, 1.0, 1.0}), control), Cancelled);
}

}  // namespace
}  // namespace elastolab
