#include <gtest/gtest.h>

#include <limits>

#include "base/error.hpp"
#include "base/lapack.hpp"
#include "deform/conjugate_gradients.hpp"

namespace elastolab {
namespace {

class DenseOperator : public LinearOperator {
public:
    explicit DenseOperator(Eigen::MatrixXd A) : A_(std::move(A)) {}
    Eigen::Index size() const override { return A_.rows(); }
    Eigen::MatrixXd product(const Eigen::MatrixXd& X) const override { return A_ * X; }

private:
    Eigen::MatrixXd A_;
};

Eigen::MatrixXd positive_definite(Eigen::Index n) {
    const Eigen::MatrixXd B = Eigen::MatrixXd::Random(n, n);
    return B * B.transpose() + Eigen::MatrixXd::Identity(n, n);
}

TEST(ConjugateGradients, AgreeWithAFactorisationForColumnsOfAnySize) {
    const Eigen::MatrixXd A = positive_definite(60);
    Eigen::MatrixXd B = Eigen::MatrixXd::Random(60, 4);
    B.col(1) *= 1e200;
    B.col(2) *= 1e-200;
    B.col(3).setZero();
    const Eigen::MatrixXd truth = LuFactorization(Eigen::MatrixXd(A), "A").solve(B);
    Control control;
    IterationReport report;
    const DenseOperator scaled(A.diagonal().cwiseInverse().asDiagonal());
    const Eigen::MatrixXd X =
        conjugate_gradients(DenseOperator(A), scaled, B, {.tolerance = 1e-12}, "matrix", control, &report);
    for (int c = 0; c < 3; ++c)
        EXPECT_LT((X.col(c) - truth.col(c)).stableNorm(), 1e-9 * truth.col(c).stableNorm()) << c;
    EXPECT_EQ(X.col(3), Eigen::VectorXd::Zero(60));
    EXPECT_LE(report.residual, 1e-12);
    EXPECT_GT(report.iterations, 1);
    EXPECT_DOUBLE_EQ(control.progress(), 1.0);
}

TEST(ConjugateGradients, GoOnFromWhatIsKnownLessExactly) {
    const Eigen::MatrixXd A = positive_definite(60);
    Eigen::MatrixXd B = Eigen::MatrixXd::Random(60, 3);
    B.col(1) *= 1e200;
    B.col(2).setZero();
    const Eigen::MatrixXd truth = LuFactorization(Eigen::MatrixXd(A), "A").solve(B);
    const DenseOperator matrix(A), scaled(A.diagonal().cwiseInverse().asDiagonal());
    Control control;
    IterationReport first, rest, all, none;
    const Eigen::MatrixXd coarse = conjugate_gradients(matrix, scaled, B, {.tolerance = 1e-4}, "A", control, &first);
    const Eigen::MatrixXd X = conjugate_gradients(matrix, scaled, B, {.start = coarse}, "A", control, &rest);
    conjugate_gradients(matrix, scaled, B, {}, "A", control, &all);
    EXPECT_GT(first.iterations, 3);
    EXPECT_LT(rest.iterations, all.iterations);
    for (int c = 0; c < 2; ++c)
        EXPECT_LT((X.col(c) - truth.col(c)).stableNorm(), 1e-5 * truth.col(c).stableNorm()) << c;
    EXPECT_EQ(X.col(2), Eigen::VectorXd::Zero(60));
    conjugate_gradients(matrix, scaled, B, {.start = truth}, "A", control, &none);
    EXPECT_EQ(none.iterations, 0);
}

TEST(ConjugateGradients, NeedOneIterationWithTheInverse) {
    const Eigen::MatrixXd A = positive_definite(30);
    Control control;
    IterationReport report;
    conjugate_gradients(DenseOperator(A), DenseOperator(A.inverse()), Eigen::MatrixXd::Random(30, 3), {}, "matrix",
                        control, &report);
    EXPECT_EQ(report.iterations, 1);
}

TEST(ConjugateGradients, SayWhenTheyDoNotConvergeAndStopWhenCancelled) {
    const DenseOperator A(positive_definite(60)), one(Eigen::MatrixXd::Identity(60, 60));
    const Eigen::MatrixXd B = Eigen::MatrixXd::Ones(60, 1);
    Control control;
    EXPECT_THROW(conjugate_gradients(A, one, B, {.tolerance = 1e-12, .max_iterations = 3}, "matrix", control),
                 SolveError);
    const DenseOperator not_finite(Eigen::MatrixXd::Constant(60, 60, std::numeric_limits<double>::quiet_NaN()));
    EXPECT_THROW(conjugate_gradients(not_finite, one, B, {}, "matrix", control), SolveError);
    control.cancel();
    EXPECT_THROW(conjugate_gradients(A, one, B, {}, "matrix", control), Cancelled);
}

/// With the inverse of A as preconditioner but for a little, the estimate of the energy is nearly exact.
TEST(ConjugateGradients, EndWhereTheEnergyOfTheErrorIsSmallEnough) {
    const Eigen::MatrixXd A = positive_definite(60), B = Eigen::MatrixXd::Random(60, 2),
                          truth = LuFactorization(Eigen::MatrixXd(A), "A").solve(B);
    const Eigen::MatrixXd near_inverse = (A + 0.3 * Eigen::MatrixXd(A.diagonal().asDiagonal())).inverse();
    Control control;
    IterationReport coarse, fine;
    const Eigen::MatrixXd X =
        conjugate_gradients(DenseOperator(A), DenseOperator(near_inverse), B,
                            {.tolerance = 1e-12, .energy_tolerance = 0.01}, "A", control, &coarse);
    conjugate_gradients(DenseOperator(A), DenseOperator(near_inverse), B, {.tolerance = 1e-12}, "A", control, &fine);
    EXPECT_LT(coarse.iterations, fine.iterations);
    for (int c = 0; c < 2; ++c) {
        const Eigen::VectorXd error = X.col(c) - truth.col(c), whole = truth.col(c);
        const double left = std::sqrt(error.dot(A * error) / whole.dot(A * whole));
        EXPECT_LT(left, 0.05) << c;
        EXPECT_GT(left, 1e-6) << c << ": and no better than that";
    }
}

TEST(ConjugateGradients, GiveWhatIsThereWhereTheyNeedNotConverge) {
    const Eigen::MatrixXd A = positive_definite(60), B = Eigen::MatrixXd::Ones(60, 1),
                          truth = LuFactorization(Eigen::MatrixXd(A), "A").solve(B);
    const DenseOperator one(Eigen::MatrixXd::Identity(60, 60));
    Control control;
    IterationReport report;
    const Eigen::VectorXd x =
        conjugate_gradients(DenseOperator(A), one, B, {.tolerance = 1e-12, .max_iterations = 5, .must_converge = false},
                            "A", control, &report);
    EXPECT_EQ(report.iterations, 5);
    const Eigen::VectorXd error = x - truth.col(0);
    EXPECT_LT(error.dot(A * error), 0.9 * truth.col(0).dot(A * truth.col(0)));
}

TEST(ConjugateGradients, SayThatAMatrixIsNotPositiveAndHaveGoneDownhill) {
    const Eigen::VectorXd diagonal = Eigen::VectorXd::LinSpaced(20, -0.5, 3.0);
    const Eigen::MatrixXd A = diagonal.asDiagonal(), B = Eigen::MatrixXd::Ones(20, 1);
    const DenseOperator one(Eigen::MatrixXd::Identity(20, 20));
    Control control;
    IterationReport report;
    const Eigen::VectorXd x = conjugate_gradients(DenseOperator(A), one, B,
                                                  {.tolerance = 1e-12, .must_converge = false}, "A", control, &report);
    EXPECT_TRUE(report.indefinite);
    EXPECT_LT(0.5 * x.dot(A * x), B.col(0).dot(x));
    conjugate_gradients(DenseOperator(positive_definite(20)), one, B, {.tolerance = 1e-12}, "A", control, &report);
    EXPECT_FALSE(report.indefinite);
}

/// Multiplies all columns but the first, of which it makes no numbers.
class FirstColumnFails : public LinearOperator {
public:
    explicit FirstColumnFails(const LinearOperator& inner) : inner_(inner) {}
    Eigen::Index size() const override { return inner_.size(); }
    Eigen::MatrixXd product(const Eigen::MatrixXd& X) const override {
        Eigen::MatrixXd Y = inner_.product(X);
        Y.col(0).setConstant(std::numeric_limits<double>::quiet_NaN());
        return Y;
    }

private:
    const LinearOperator& inner_;
};

TEST(ConjugateGradients, StopAtTheFirstResidualThatIsNoNumber) {
    const DenseOperator A(positive_definite(60)), one(Eigen::MatrixXd::Identity(60, 60));
    Control control;
    IterationReport report;
    EXPECT_THROW(conjugate_gradients(FirstColumnFails(A), one, Eigen::MatrixXd::Ones(60, 3), {.tolerance = 1e-12}, "A",
                                     control, &report),
                 SolveError);
    EXPECT_EQ(report.iterations, 1);
}

}  // namespace
}  // namespace elastolab
