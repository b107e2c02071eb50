// A free chain of springs, the same along each axis, whose answers are known: between constrained nodes the
// displacement is linear, beyond them it is constant.
#include "deform/reduced_solver.hpp"

#include <gmock/gmock.h>

#include "base/error.hpp"
#include "base/lapack.hpp"

namespace elastolab {
namespace {

constexpr double kRounding = 1e-12;
constexpr int kNodes = 6;

/// Row and column blocks of 3 x 3 unit matrices.
Eigen::MatrixXd for_each_axis(const Eigen::MatrixXd& small) {
    Eigen::MatrixXd large = Eigen::MatrixXd::Zero(3 * small.rows(), 3 * small.cols());
    for (Eigen::Index i = 0; i < small.rows(); ++i)
        for (Eigen::Index j = 0; j < small.cols(); ++j)
            large.block<3, 3>(3 * i, 3 * j) = small(i, j) * Eigen::Matrix3d::Identity();
    return large;
}

/// Stiffness of the chain: springs of stiffness 1 between neighbours.
Eigen::MatrixXd stiffness() {
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(kNodes, kNodes);
    for (int i = 0; i + 1 < kNodes; ++i) K.block<2, 2>(i, i) += (Eigen::Matrix2d() << 1, -1, -1, 1).finished();
    return for_each_axis(K);
}

Eigen::MatrixXd translations(Eigen::Index n) { return for_each_axis(Eigen::MatrixXd::Ones(n, 1)); }

/// u = K^+ q + R c, R^T q = 0: loads at the constrained nodes, translations as border. extra: columns of the border
/// that repeat its first.
ReducedSystem chain(const std::vector<int>& constrained, int extra = 0) {
    const Eigen::Index n_loads = 3 * std::ssize(constrained), n_border = 3 + extra;
    const Eigen::MatrixXd K_inverse =
        solve_minimum_norm(stiffness(), Eigen::MatrixXd::Identity(3 * kNodes, 3 * kNodes)).X;
    Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(3 * kNodes + n_border, n_border);
    rigid.topLeftCorner(3 * kNodes, 3) = translations(kNodes);
    for (int i = 0; i < extra; ++i) rigid.col(3 + i) = rigid.col(0);
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(3 * kNodes + n_border, n_loads);
    for (std::size_t i = 0; i < constrained.size(); ++i) {
        const auto at = 3 * static_cast<Eigen::Index>(i);
        columns.block(0, at, 3 * kNodes, 3) = K_inverse.middleCols<3>(3 * constrained[i]);
        columns.block<3, 3>(3 * kNodes, at) = Eigen::Matrix3d::Identity();
    }
    for (int i = 0; i < extra; ++i) columns.row(3 * kNodes + 3 + i) = columns.row(3 * kNodes);
    return {.compliance_columns = std::make_shared<const KeptComplianceColumns>(
                Columns({std::make_shared<const Eigen::MatrixXd>(std::move(columns))})),
            .rigid = std::move(rigid),
            .nodes = constrained,
            .n_loads = n_loads};
}

Eigen::MatrixXd solved(const ReducedSolver& solver, const Eigen::MatrixXd& prescribed) {
    return solver.solve(prescribed, false).displacements;
}

TEST(ReducedSolver, InterpolatesBetweenTheConstrainedNodesOfAChain) {
    Control control;
    const ReducedSolver solver(chain({1, 4}), control);
    Eigen::MatrixXd prescribed(6, 2);
    prescribed << 0, 1, 0, 2, 0, 3, 3, 1, 0, 2, -6, 3;
    const Eigen::MatrixXd u = solved(solver, prescribed);
    ASSERT_EQ(u.rows(), 3 * kNodes);
    for (int node = 0; node < kNodes; ++node) {
        const double s = std::clamp((node - 1) / 3.0, 0.0, 1.0);
        const Eigen::Vector3d expected(3.0 * s, 0.0, -6.0 * s);
        EXPECT_LT((u.col(0).segment<3>(3 * node) - expected).norm(), kRounding) << node;
        EXPECT_LT((u.col(1).segment<3>(3 * node) - Eigen::Vector3d(1, 2, 3)).norm(), kRounding)
            << node;  // a translation
    }
    EXPECT_TRUE(solver.held());
    EXPECT_GE(solver.condition(), 1.0);
    EXPECT_LT(solver.condition(), 1e3);
}

TEST(ReducedSolver, TellsTheLoadsThatHoldTheAnswer) {
    Control control;
    const std::vector<int> nodes = {0, 2, 5};
    const ReducedSolver solver(chain(nodes), control);
    const Eigen::VectorXd prescribed = Eigen::VectorXd::LinSpaced(9, -1.0, 2.0).array().square();
    const NodeSolution solution = solver.solve(prescribed, true);
    const Eigen::VectorXd force = stiffness() * solution.displacements;
    ASSERT_EQ(solution.loads.rows(), 9);
    for (std::size_t i = 0; i < nodes.size(); ++i)
        EXPECT_LT(
            (force.segment<3>(3 * nodes[i]) - solution.loads.middleRows<3>(3 * static_cast<Eigen::Index>(i))).norm(),
            kRounding);
    for (const int free : {1, 3, 4}) EXPECT_LT(force.segment<3>(3 * free).norm(), kRounding);
    EXPECT_LT((translations(3).transpose() * solution.loads).norm(), kRounding);  // balanced
}

/// Prescribed displacements are exact, not exact but for rounding.
TEST(ReducedSolver, GivesBackWhatWasPrescribed) {
    Control control;
    const std::vector<int> nodes = {5, 0, 3};
    const Eigen::VectorXd prescribed = Eigen::VectorXd::Random(9) / 3.0;
    const Eigen::MatrixXd u = solved(ReducedSolver(chain(nodes), control), prescribed);
    for (std::size_t i = 0; i < nodes.size(); ++i)
        EXPECT_EQ((u.middleRows<3>(3 * nodes[i])), (prescribed.segment<3>(3 * static_cast<Eigen::Index>(i))));
}

/// A border that repeats itself makes the system singular; the answer is not.
TEST(ReducedSolver, TakesTheSmallestSolutionOfASingularSystem) {
    Control control;
    const ReducedSolver sound(chain({1, 4}), control), singular(chain({1, 4}, 1), control);
    EXPECT_FALSE(singular.held());
    EXPECT_GT(singular.condition(), 1e12);
    const Eigen::VectorXd prescribed = Eigen::VectorXd::LinSpaced(6, 0.0, 1.0);
    EXPECT_LT((solved(singular, prescribed) - solved(sound, prescribed)).norm(), 1e-9);
}

TEST(ReducedSolver, RefusesResponsesThatAreNotFinite) {
    Control control;
    ReducedSystem system = chain({1, 4});
    system.rigid(3, 0) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(ReducedSolver(std::move(system), control), SolveError);
}

TEST(ReducedSolver, CanBeCancelled) {
    Control control;
    const ReducedSolver solver(chain({1, 4}), control);
    control.cancel();
    EXPECT_THROW(solver.solve_watched(Eigen::VectorXd::Zero(6), false, kSolveTolerance, control), Cancelled);
}

}  // namespace
}  // namespace elastolab
