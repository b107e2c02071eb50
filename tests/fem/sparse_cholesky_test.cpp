#include "fem/sparse_cholesky.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <Eigen/Dense>
#include <limits>
#include <string>
#include <thread>

#include "base/blas.hpp"
#include "base/error.hpp"
#include "base/lapack.hpp"
#include "fem/constraints.hpp"
#include "fem/fem_body.hpp"

namespace elastolab {
namespace {

using test::FemBody;
using test::relative_error;

TEST(SparseCholesky, SolvesForManyRightHandSides) {
    const FemBody body({5, 4, 4});
    const SparseMatrix A = grounded(body.K, body.mesh.vertices, choose_support(body.mesh.vertices, body.n_surface()));
    const SparseCholesky factor(body.analysis, A, "A");
    const Eigen::MatrixXd X = Eigen::MatrixXd::Random(A.rows(), 70);
    EXPECT_LT(relative_error(factor.solve(A * X), X), 1e-11);
    EXPECT_EQ(factor.solve(Eigen::MatrixXd(A.rows(), 0)).cols(), 0);
}

TEST(SparseCholesky, ReusesItsAnalysisForOtherValues) {
    const FemBody body({4, 4, 3});
    const std::vector<int> left = body.face(0, 0.0), right = body.face(0, 1.0);
    for (const std::vector<int>& fixed : {left, right}) {
        const SparseMatrix A = eliminated(body.K, fixed);
        const Eigen::MatrixXd X = Eigen::MatrixXd::Random(A.rows(), 3);
        EXPECT_LT(relative_error(SparseCholesky(body.analysis, A, "A").solve(A * X), X), 1e-11);
    }
}

TEST(SparseCholesky, FactorisesAPatternWithoutGroups) {
    SparseMatrix A(5, 5);
    for (int i = 0; i < 5; ++i) A.insert(i, i) = 4.0;
    for (int i = 0; i < 4; ++i) A.insert(i, i + 1) = A.insert(i + 1, i) = -1.0;
    A.makeCompressed();
    const CholeskyAnalysis analysis(A, 1);
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(5, 1.0, 2.0);
    EXPECT_LT(relative_error(SparseCholesky(analysis, A, "A").solve(A * x), x), 1e-15);
}

TEST(SparseCholesky, EstimatesTheCondition) {
    const FemBody body({4, 3, 3});
    const SparseMatrix A = eliminated(body.K, body.face(1, 0.0));
    const Eigen::MatrixXd dense(A);
    const auto norm = [](const Eigen::MatrixXd& B) { return B.cwiseAbs().colwise().sum().maxCoeff(); };
    const double exact = 1.0 / (norm(dense) * norm(spd_inverse(dense, "stiffness")));
    const double estimate = SparseCholesky(body.analysis, A, "A").reciprocal_condition();
    EXPECT_GE(estimate, 0.999 * exact);  // the norm of the inverse is estimated from below
    EXPECT_LE(estimate, 3.0 * exact);
}

TEST(SparseCholesky, RefusesWhatIsNotPositiveDefinite) {
    const FemBody body({2, 2, 2});
    EXPECT_THROW(SparseCholesky(body.analysis, -body.K, "A"), SolveError);
    SparseMatrix broken = body.K;
    broken.valuePtr()[0] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(SparseCholesky(body.analysis, broken, "A"), SolveError);
}

/// A maximum over the columns may pass over one that is NaN.
TEST(SparseCholesky, RefusesAnEntryThatIsNotFiniteWhereverItIs) {
    constexpr int kSize = 9;
    for (int i = 0; i < kSize; ++i)
        for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
            SparseMatrix A(kSize, kSize);
            for (int k = 0; k < kSize; ++k) A.insert(k, k) = k == i ? bad : 1.0 + k;
            A.makeCompressed();
            try {
                const SparseCholesky factor(CholeskyAnalysis(A, 1), A, "A");
                ADD_FAILURE() << i;
            } catch (const SolveError& error) {
                EXPECT_NE(std::string(error.what()).find("not finite"), std::string::npos) << i << error.what();
            }
        }
}

TEST(SparseCholesky, EqualsTheDenseFactor) {
    // Large enough for several parts of the elimination tree, and for supernodes of more than one panel.
    const FemBody body({14, 12, 12});
    const SparseMatrix A = eliminated(body.K, body.face(0, 0.0));
    const SparseCholesky factor(body.analysis, A, "A");
    const SupernodalView L = factor.view();
    int widest = 0;
    for (int s = 0; s < L.n_supernodes(); ++s)
        widest = std::max(widest, L.super[static_cast<std::size_t>(s) + 1] - L.super[static_cast<std::size_t>(s)]);
    EXPECT_GT(widest, 192);
    // P A P^T x = L L^T x, by the entries of L.
    const Eigen::Index n = A.rows();
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
    for (int s = 0; s < L.n_supernodes(); ++s) {
        const auto i = static_cast<std::size_t>(s);
        const int columns = L.super[i + 1] - L.super[i], rows = L.first_row[i + 1] - L.first_row[i];
        for (int c = 0; c < columns; ++c)
            for (int r = c; r < rows; ++r)
                dense(L.rows[static_cast<std::size_t>(L.first_row[i] + r)], L.super[i] + c) =
                    L.values[L.first_value[i] + r + static_cast<std::ptrdiff_t>(c) * rows];
    }
    const Eigen::VectorXd x = Eigen::VectorXd::Random(n);
    Eigen::VectorXd permuted(n), expected(n);
    for (Eigen::Index i = 0; i < n; ++i) permuted[i] = x[L.permutation[static_cast<std::size_t>(i)]];
    const Eigen::VectorXd Ax = A * x;
    for (Eigen::Index i = 0; i < n; ++i) expected[i] = Ax[L.permutation[static_cast<std::size_t>(i)]];
    EXPECT_LT(relative_error(dense * (dense.transpose() * permuted), expected), 1e-13);
}

TEST(SparseCholesky, DoesNotDependOnTheNumberOfThreads) {
    const FemBody body({8, 7, 6});
    const SparseMatrix A = eliminated(body.K, body.face(0, 0.0));
    const Eigen::VectorXd b = Eigen::VectorXd::Ones(A.rows());
    const int before = thread_count();
    set_thread_count(1);
    const Eigen::MatrixXd one = SparseCholesky(body.analysis, A, "A").solve(b);
    set_thread_count(3);
    const Eigen::MatrixXd three = SparseCholesky(body.analysis, A, "A").solve(b);
    set_thread_count(before);
    EXPECT_LT(relative_error(three, one), 1e-13);
}

TEST(SparseCholesky, StopsInTheMiddleAndTellsHowFarItIs) {
    const FemBody body({16, 14, 14});
    const SparseMatrix A = eliminated(body.K, body.face(0, 0.0));
    Control whole;
    const SparseCholesky factor(body.analysis, A, "A", &whole);
    EXPECT_NEAR(whole.progress(), 1.0, 1e-9);
    // A busy machine may leave the watcher asleep until all is done: then once more.
    bool stopped = false;
    for (int attempt = 0; attempt < 50 && !stopped; ++attempt) {
        Control control;
        std::thread watcher([&] {
            const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
            while (control.progress() == 0.0 && std::chrono::steady_clock::now() < end) std::this_thread::yield();
            control.cancel();
        });
        try {
            const SparseCholesky unwanted(body.analysis, A, "A", &control);
        } catch (const Cancelled&) {
            stopped = true;
            EXPECT_GT(control.progress(), 0.0);
            EXPECT_LT(control.progress(), 1.0);
        }
        watcher.join();
    }
    EXPECT_TRUE(stopped);
}

TEST(SparseCholesky, CountsItsMemory) {
    const FemBody body({4, 4, 4});
    const SparseCholesky factor(body.analysis, eliminated(body.K, body.face(0, 0.0)), "A");
    EXPECT_EQ(factor.memory_bytes(), body.analysis.factor_bytes());
    EXPECT_GT(factor.memory_bytes(), 8u * static_cast<unsigned>(body.K.nonZeros()) / 2);
}

}  // namespace
}  // namespace elastolab
