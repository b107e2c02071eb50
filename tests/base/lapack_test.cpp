#include "base/lapack.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

#include "base/error.hpp"

namespace elastolab {
namespace {

using Eigen::MatrixXd;

/// Tall, wide, square, a row, a column; full rank and not.
std::vector<MatrixXd> matrices() {
    std::srand(3);
    std::vector<MatrixXd> all;
    for (const auto& [m, n] : {std::pair{9, 4}, {4, 9}, {6, 6}, {1, 5}, {5, 1}}) all.push_back(MatrixXd::Random(m, n));
    all.push_back(MatrixXd::Random(8, 2) * MatrixXd::Random(2, 5));
    all.push_back(MatrixXd::Zero(3, 2));
    return all;
}

bool is_orthonormal(const MatrixXd& Q) {
    return (Q.transpose() * Q - MatrixXd::Identity(Q.cols(), Q.cols())).norm() < 1e-13;
}

TEST(QrFactorization, GivesTheMatrixBack) {
    for (const MatrixXd& A : matrices()) {
        const QrFactorization qr(A);
        const Eigen::Index k = std::min(A.rows(), A.cols());
        const MatrixXd Q = qr.times_Q(MatrixXd::Identity(k, k)), R = qr.R();
        EXPECT_EQ(R.rows(), k);
        EXPECT_TRUE(is_orthonormal(Q));
        EXPECT_LT((Q * R - A).norm(), 1e-13 * (1.0 + A.norm()));
        EXPECT_EQ(MatrixXd(R.triangularView<Eigen::StrictlyLower>()).norm(), 0.0);
    }
}

TEST(SingularValues, GiveTheMatrixBack) {
    for (const MatrixXd& A : matrices()) {
        const SingularValues svd = singular_values(A);
        ASSERT_EQ(svd.sigma.size(), std::min(A.rows(), A.cols()));
        EXPECT_TRUE(is_orthonormal(svd.U));
        EXPECT_TRUE(is_orthonormal(svd.V));
        EXPECT_LT((svd.U * svd.sigma.asDiagonal() * svd.V.transpose() - A).norm(), 1e-13 * (1.0 + A.norm()));
        for (Eigen::Index i = 1; i < svd.sigma.size(); ++i) EXPECT_GE(svd.sigma[i - 1], svd.sigma[i]);
        EXPECT_GE(svd.sigma.minCoeff(), 0.0);
    }
    EXPECT_LT(singular_values(matrices()[5]).sigma[2], 1e-13);  // of rank two
    EXPECT_EQ(singular_values(MatrixXd(0, 3)).sigma.size(), 0);
}

TEST(SingularValues, RefuseEntriesThatAreNotFinite) {
    MatrixXd A = MatrixXd::Identity(3, 3);
    A(1, 2) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(singular_values(A), SolveError);
}

TEST(MinimumNorm, IsTheShortestOfTheLeastSquaresSolutions) {
    for (const MatrixXd& A : matrices()) {
        const MatrixXd B = MatrixXd::Random(A.rows(), 3);
        const MinimumNormSolution found = solve_minimum_norm(A, B);
        ASSERT_EQ(found.X.rows(), A.cols());
        EXPECT_LT((A.transpose() * (A * found.X - B)).norm(), 1e-12 * (1.0 + A.squaredNorm()));
        const SingularValues svd = singular_values(A);
        const Eigen::Index rank = (svd.sigma.array() > 1e-12).count();
        EXPECT_EQ(found.rank, rank);
        const MatrixXd rows = svd.V.leftCols(rank);  // nothing beside the space of the rows
        EXPECT_LT((found.X - rows * (rows.transpose() * found.X)).norm(), 1e-12 * (1.0 + found.X.norm()));
    }
    EXPECT_EQ(solve_minimum_norm(MatrixXd(4, 0), MatrixXd::Ones(4, 2)).X.size(), 0);
}

TEST(SymmetricEigen, GivesTheMatrixBackFromItsLowerTriangle) {
    for (const MatrixXd& B : matrices()) {
        MatrixXd A = B.transpose() * B;
        const MatrixXd whole = A;
        A.triangularView<Eigen::StrictlyUpper>().setConstant(std::numeric_limits<double>::max());
        const SymmetricEigen eigen = symmetric_eigen(A);
        EXPECT_TRUE(is_orthonormal(eigen.vectors));
        EXPECT_LT((eigen.vectors * eigen.values.asDiagonal() * eigen.vectors.transpose() - whole).norm(),
                  1e-13 * (1.0 + whole.norm()));
        for (Eigen::Index i = 1; i < eigen.values.size(); ++i) EXPECT_GE(eigen.values[i], eigen.values[i - 1]);
    }
    EXPECT_EQ(symmetric_eigen(MatrixXd(0, 0)).values.size(), 0);
}

TEST(RealPartsOfEigenvalues, AreThoseOfTrianglesAndTurns) {
    MatrixXd A(4, 4);  // of -3, of 5 and of a block whose eigenvalues are 1 +- 2i
    A << 1, -2, 7, 1,  //
        2, 1, 0, 4,    //
        0, 0, 5, 9,    //
        0, 0, 0, -3;
    EXPECT_LT((real_parts_of_eigenvalues(A) - Eigen::Vector4d(-3, 1, 1, 5)).norm(), 1e-12);
    EXPECT_EQ(real_parts_of_eigenvalues(MatrixXd(0, 0)).size(), 0);
    A(2, 1) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(real_parts_of_eigenvalues(A), SolveError);
}

TEST(SymmetricEigen, RefusesEntriesThatAreNotFinite) {
    MatrixXd A = MatrixXd::Identity(3, 3);
    A(2, 1) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(symmetric_eigen(A), SolveError);
}

}  // namespace
}  // namespace elastolab
