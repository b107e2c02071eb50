#include "base/blocked_lu.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <limits>

#include "base/error.hpp"
#include "base/lapack.hpp"

namespace elastolab {
namespace {

constexpr int kSize = 700, kAtOnce = 300;  // larger ones by blocks

/// |P A - L U| over |A|, from the factors and exchanges alone.
template <class Matrix>
double reconstruction_error(const Matrix& A, const Matrix& factors, const std::vector<int>& pivots) {
    Matrix rows = A;
    for (Eigen::Index i = 0; i < A.rows(); ++i) rows.row(i).swap(rows.row(pivots[static_cast<std::size_t>(i)] - 1));
    const Matrix upper = factors.template triangularView<Eigen::Upper>();
    const Matrix product = factors.template triangularView<Eigen::UnitLower>() * upper;
    return static_cast<double>((rows - product).norm() / A.norm());
}

template <class Matrix>
void expect_factors(int n, double tolerance) {
    const Matrix A = Matrix::Random(n, n);
    Matrix factors = A;
    std::vector<int> pivots;
    EXPECT_EQ(factorise_lu(factors, pivots, nullptr, kAtOnce), 0);
    EXPECT_LT(reconstruction_error(A, factors, pivots), tolerance);
    const Matrix lower = factors.template triangularView<Eigen::StrictlyLower>();
    EXPECT_LE(lower.cwiseAbs().maxCoeff(), 1.0) << "pivots are the largest of their columns";
}

TEST(BlockedLu, GivesFactorsOfTheMatrixWithItsRowsExchanged) {
    for (const int n : {kAtOnce, kSize}) {
        expect_factors<Eigen::MatrixXd>(n, 1e-13);
        expect_factors<Eigen::MatrixXf>(n, 1e-4);
    }
}

TEST(BlockedLu, NamesTheFirstPivotThatVanishes) {
    Eigen::MatrixXd A = Eigen::MatrixXd::Identity(kSize, kSize);
    A.row(400).setZero();
    A.row(600).setZero();
    std::vector<int> pivots;
    EXPECT_EQ(factorise_lu(A, pivots, nullptr, kAtOnce), 401);
}

TEST(BlockedLu, TellsItsProgressAndCanBeCancelled) {
    Eigen::MatrixXd A = Eigen::MatrixXd::Random(kSize, kSize);
    std::vector<int> pivots;
    Control control;
    factorise_lu(A, pivots, &control, kAtOnce);
    EXPECT_GT(control.progress(), 0.9);
    control.cancel();
    EXPECT_THROW(factorise_lu(A, pivots, &control, kAtOnce), Cancelled);
}

/// A factorisation of a second can be cancelled on the way, not at its beginning only.
TEST(BlockedLu, TellsItsProgressFromAThousandVerticesOn) {
    constexpr int kRows = 3 * 1050;
    Eigen::MatrixXf A = Eigen::MatrixXf::Identity(kRows, kRows);
    std::vector<int> pivots;
    Control control;
    factorise_lu(A, pivots, &control);
    EXPECT_GT(control.progress(), 0.9);
}

/// A maximum over the columns may pass over one that is NaN.
TEST(LuFactorization, RefusesAnEntryThatIsNotFiniteWhereverItIs) {
    constexpr int kSmall = 9;
    for (int i = 0; i < kSmall * kSmall; ++i)
        for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
            Eigen::MatrixXd A = Eigen::MatrixXd::Random(kSmall, kSmall);
            A.reshaped()[i] = bad;
            EXPECT_THROW(LuFactorization(std::move(A), "A"), SolveError) << i;
        }
}

}  // namespace
}  // namespace elastolab
