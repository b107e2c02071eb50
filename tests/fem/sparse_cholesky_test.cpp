#include "fem/sparse_cholesky.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>
#include <string>

#include "base/error.hpp"
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
    for (const std::vector<int>& base : {left, right}) {
        const SparseMatrix A = eliminated(body.K, base);
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
    const double exact =
        1.0 / (dense.cwiseAbs().colwise().sum().maxCoeff() * dense.inverse().cwiseAbs().colwise().sum().maxCoeff());
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

TEST(SparseCholesky, CountsItsMemory) {
    const FemBody body({4, 4, 4});
    const SparseCholesky factor(body.analysis, eliminated(body.K, body.face(0, 0.0)), "A");
    EXPECT_EQ(factor.memory_bytes(), body.analysis.factor_bytes());
    EXPECT_GT(factor.memory_bytes(), 8u * static_cast<unsigned>(body.K.nonZeros()) / 2);
}

}  // namespace
}  // namespace elastolab
