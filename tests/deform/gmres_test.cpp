#include "deform/gmres.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/lapack.hpp"

namespace elastolab::test {
namespace {

class Dense : public LinearOperator {
public:
    explicit Dense(Eigen::MatrixXd A) : A_(std::move(A)) {}
    Eigen::Index size() const override { return A_.rows(); }
    Eigen::MatrixXd product(const Eigen::MatrixXd& X) const override {
        ++products;
        return A_ * X;
    }
    mutable int products = 0;

private:
    Eigen::MatrixXd A_;
};

/// In single precision, as preconditioners are.
class Rounded : public LinearOperator {
public:
    explicit Rounded(const Eigen::MatrixXd& A) : A_(A.cast<float>()) {}
    Eigen::Index size() const override { return A_.rows(); }
    Eigen::MatrixXd product(const Eigen::MatrixXd& X) const override { return (A_ * X.cast<float>()).cast<double>(); }

private:
    Eigen::MatrixXf A_;
};

/// Regular, without symmetry, far from the identity.
Eigen::MatrixXd skewed(int n) {
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
    for (int i = 0; i < n; ++i) {
        A(i, i) = 1.0 + i;
        if (i > 0) A(i, i - 1) = -3.0;
        if (i + 2 < n) A(i, i + 2) = 1.5 + 0.1 * i;
    }
    return A;
}

Eigen::MatrixXd right_sides(int n) {
    Eigen::MatrixXd B(n, 3);
    for (int i = 0; i < n; ++i) B.row(i) << std::sin(i), 1e200 * std::cos(3.0 * i), 0.0;
    return B;
}

TEST(Gmres, SolvesWhatIsNotSymmetricColumnByColumn) {
    const int n = 60;
    const Eigen::MatrixXd A = skewed(n), B = right_sides(n), truth = LuFactorization(Eigen::MatrixXd(A), "A").solve(B);
    Control control;
    IterationReport report;
    const Eigen::MatrixXd X =
        gmres(Dense(A), Dense(Eigen::MatrixXd::Identity(n, n)), B, {.tolerance = 1e-12}, "test", control, &report);
    for (int c = 0; c < 2; ++c)
        EXPECT_LT((X.col(c) - truth.col(c)).stableNorm(), 1e-9 * truth.col(c).stableNorm()) << c;
    EXPECT_EQ(X.col(2).cwiseAbs().maxCoeff(), 0.0) << "nothing asked for, nothing answered";
    EXPECT_LE(report.iterations, n) << "exact after as many steps as unknowns";
    EXPECT_LE(report.residual, 1e-12);
}

TEST(Gmres, GoesOnFromWhatIsKnownLessExactly) {
    const int n = 60;
    const Eigen::MatrixXd A = skewed(n), B = right_sides(n), truth = LuFactorization(Eigen::MatrixXd(A), "A").solve(B);
    const Dense dense(A), diagonal(A.diagonal().cwiseInverse().asDiagonal());
    Control control;
    IterationReport first, rest, all, none;
    const Eigen::MatrixXd coarse = gmres(dense, diagonal, B, {.tolerance = 1e-4}, "test", control, &first);
    const Eigen::MatrixXd X = gmres(dense, diagonal, B, {.start = coarse}, "test", control, &rest);
    gmres(dense, diagonal, B, {}, "test", control, &all);
    EXPECT_GT(first.iterations, 3);
    EXPECT_LE(rest.iterations + 2, all.iterations);
    for (int c = 0; c < 2; ++c)
        EXPECT_LT((X.col(c) - truth.col(c)).stableNorm(), 1e-6 * truth.col(c).stableNorm()) << c;
    EXPECT_EQ(X.col(2).cwiseAbs().maxCoeff(), 0.0);
    gmres(dense, diagonal, B, {.start = truth}, "test", control, &none);
    EXPECT_EQ(none.iterations, 0);
}

TEST(Gmres, BeginsAnewWhenItsBasisIsUsedUp) {
    const int n = 60;
    const Eigen::MatrixXd A = skewed(n), B = right_sides(n).leftCols(1),
                          truth = LuFactorization(Eigen::MatrixXd(A), "A").solve(B);
    Control control;
    const Eigen::MatrixXd diagonal = A.diagonal().cwiseInverse().asDiagonal();
    IterationReport report;
    const Eigen::MatrixXd X =
        gmres(Dense(A), Dense(diagonal), B, {.tolerance = 1e-10, .basis = 6}, "test", control, &report);
    EXPECT_GT(report.iterations, 6);
    EXPECT_LT((X - truth).norm(), 1e-7 * truth.norm());
}

TEST(Gmres, APreconditionerInSinglePrecisionCostsNoDigits) {
    const int n = 60;
    const Eigen::MatrixXd A = skewed(n), B = right_sides(n).leftCols(1),
                          truth = LuFactorization(Eigen::MatrixXd(A), "A").solve(B);
    Control control;
    const Dense dense(A);
    const Eigen::MatrixXd X = gmres(dense, Rounded(A.inverse()), B, {.tolerance = 1e-12}, "test", control);
    EXPECT_LT((X - truth).norm(), 1e-10 * truth.norm());
    EXPECT_LT(dense.products, 6);
}

TEST(Gmres, SaysWhenItDoesNotConverge) {
    const int n = 40;
    Eigen::MatrixXd shift = Eigen::MatrixXd::Zero(n, n);  // a cycle: no progress before step n
    for (int i = 0; i < n; ++i) shift((i + 1) % n, i) = 1.0;
    Eigen::MatrixXd B = Eigen::MatrixXd::Zero(n, 1);
    B(0, 0) = 1.0;
    Control control;
    const Dense identity(Eigen::MatrixXd::Identity(n, n));
    EXPECT_THROW(gmres(Dense(shift), identity, B, {.basis = 10}, "test", control), SolveError);
    EXPECT_LT((shift * gmres(Dense(shift), identity, B, {}, "test", control) - B).norm(), 1e-8);
    Eigen::MatrixXd nothing = Eigen::MatrixXd::Ones(n, 2);
    nothing(3, 0) = std::nan("");
    EXPECT_THROW(gmres(Dense(shift), identity, nothing, {}, "test", control), SolveError);
    control.cancel();
    EXPECT_THROW(gmres(Dense(shift), identity, B, {}, "test", control), Cancelled);
}

}  // namespace
}  // namespace elastolab::test
