#include "base/refined_lu.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/error.hpp"
#include "base/lapack.hpp"

namespace elastolab {
namespace {

/// A random orthogonal matrix of this size.
Eigen::MatrixXd orthogonal(Eigen::Index n, unsigned seed) {
    std::srand(seed);
    return QrFactorization(Eigen::MatrixXd::Random(n, n)).times_Q(Eigen::MatrixXd::Identity(n, n));
}

/// A matrix with this condition number (2-norm), singular values evenly spread over the decades.
Eigen::MatrixXd with_condition(Eigen::Index n, double condition) {
    const Eigen::VectorXd decades = Eigen::VectorXd::LinSpaced(n, 0.0, -std::log10(condition));
    return orthogonal(n, 1) * decades.unaryExpr([](double d) { return std::pow(10.0, d); }).asDiagonal() *
           orthogonal(n, 2).transpose();
}

/// Relative error of the solution for a known one.
double error_of(const RefinedLu& lu, const Eigen::MatrixXd& A, double scale = 1.0) {
    const Eigen::MatrixXd exact = scale * Eigen::MatrixXd::Random(A.rows(), 3);
    return (lu.solve(A * exact) - exact).norm() / exact.norm();
}

TEST(RefinedLu, SolvesAsWellAsDoublePrecision) {
    for (const double condition : {10.0, 1e3}) {
        const Eigen::MatrixXd A = with_condition(400, condition);
        const RefinedLu lu(Eigen::MatrixXd(A), "matrix");
        EXPECT_TRUE(lu.is_single());
        EXPECT_EQ(lu.size(), 400);
        EXPECT_LT(error_of(lu, A), 1e-15 * 20.0 * condition) << condition;
        EXPECT_LT(error_of(lu, A, 1e-100), 1e-15 * 20.0 * condition) << condition << ", tiny";
        EXPECT_LT(error_of(lu, A, 1e100), 1e-15 * 20.0 * condition) << condition << ", huge";
    }
}

TEST(RefinedLu, TakesDoublePrecisionWhereSingleDoesNotDo) {
    const Eigen::MatrixXd poor = with_condition(400, 1e9);
    const RefinedLu lu(Eigen::MatrixXd(poor), "matrix");
    EXPECT_FALSE(lu.is_single());
    EXPECT_EQ(lu.size(), 400);
    EXPECT_LT(error_of(lu, poor), 1e-6);
    const Eigen::MatrixXd huge = 1e200 * with_condition(400, 10.0);
    EXPECT_FALSE(RefinedLu(Eigen::MatrixXd(huge), "matrix").is_single());
    EXPECT_LT(error_of(RefinedLu(Eigen::MatrixXd(huge), "matrix"), huge), 1e-13);
}

/// Rows of very different size defeat single precision although the estimate of the condition, of the matrix in the
/// 1-norm, need not tell.
TEST(RefinedLu, IsRightWhateverTheScaleOfTheRows) {
    Eigen::MatrixXd A = with_condition(400, 100.0);
    for (Eigen::Index i = 0; i < A.rows(); i += 2) A.row(i) *= 1e-4;
    const RefinedLu lu(Eigen::MatrixXd(A), "matrix");
    EXPECT_LT(error_of(lu, A), 1e-9);
}

TEST(RefinedLu, EstimatesTheCondition) {
    const Eigen::MatrixXd A = with_condition(400, 1e3);
    const double single = RefinedLu(Eigen::MatrixXd(A), "matrix").reciprocal_condition();
    const double twice = LuFactorization(Eigen::MatrixXd(A), "matrix").reciprocal_condition();
    EXPECT_NEAR(single, twice, 1e-3 * twice);
}

TEST(RefinedLu, RefusesWhatHasNoSolution) {
    Eigen::MatrixXd A = Eigen::MatrixXd::Ones(300, 300);
    EXPECT_THROW(RefinedLu(Eigen::MatrixXd(Eigen::MatrixXd::Zero(300, 300)), "matrix"), SingularMatrixError);
    A(7, 8) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(RefinedLu(std::move(A), "matrix"), SolveError);
    EXPECT_EQ(RefinedLu(Eigen::MatrixXd(0, 0), "matrix").size(), 0);
}

}  // namespace
}  // namespace elastolab
