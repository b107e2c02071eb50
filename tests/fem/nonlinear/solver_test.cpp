// Equilibria of bars: exact homogeneous states, iteration counts of docs/formulation.md, balance, paths and failures.
#include "fem/nonlinear/solver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "elasticity/neo_hookean.hpp"
#include "fem/nonlinear/bodies.hpp"

namespace elastolab {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::affine;
using test::elements_of_box;
using test::HeldBar;
using test::rotation;

const NewtonState& state_of(const NodeSolution& solution) {
    return dynamic_cast<const NonlinearState&>(*solution.state).newton();
}
int iterations(const NodeSolution& solution) { return solution.state->facts().iterations; }
double rms(const Eigen::VectorXd& a, const Eigen::VectorXd& b) { return (a - b).norm() / b.norm(); }

/// Lateral stretch of a bar with free sides that is stretched by `stretch`: P_22 = 0.
double lateral_stretch(const Material& material, double stretch) {
    const NeoHookean law(material);
    double low = 0.1, high = 3.0;
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        const Matrix3d F = Vector3d(stretch, middle, middle).asDiagonal();
        (law.first_piola(F - Matrix3d::Identity())(1, 1) > 0.0 ? high : low) = middle;
    }
    return 0.5 * (low + high);
}

class BarOfDegree : public testing::TestWithParam<ElementDegree> {};
INSTANTIATE_TEST_SUITE_P(NonlinearSolver, BarOfDegree, testing::Values(ElementDegree::linear, ElementDegree::quadratic),
                         [](const auto& degree) {
                             return degree.param == ElementDegree::linear ? "FourNodes" : "TenNodes";
                         });

/// The ends move as in uniform stretch, so that all of the body does.
TEST_P(BarOfDegree, UniformStretchIsExact) {
    for (const double stretch : {0.6, 1.5, 2.5}) {
        const Material material{1.0, 0.3};
        const auto elements = elements_of_box({3, 2, 2}, {2, 1, 1}, GetParam(), 0.1);
        const double lateral = lateral_stretch(material, stretch);
        const Matrix3d F = Vector3d(stretch, lateral, lateral).asDiagonal();
        const std::vector<int> ends =
            test::nodes_where(*elements, [](const auto& p) { return p[0] == 0.0 || p[0] == 2.0; });
        Control control;
        const NonlinearSolver solver(elements, material, {ends, 0, true}, control);
        const Eigen::VectorXd exact = affine(*elements, F);
        Eigen::VectorXd values(3 * std::ssize(ends));
        for (std::size_t i = 0; i < ends.size(); ++i)
            values.segment<3>(3 * static_cast<Eigen::Index>(i)) = exact.segment<3>(3 * ends[i]);
        const NodeSolution solution = solver.solve(values, true);
        EXPECT_LT(rms(solution.displacements, exact), 1e-8) << stretch;
        const double force = NeoHookean(material).first_piola(F - Matrix3d::Identity())(0, 0);
        double sum = 0.0;
        for (std::size_t i = 0; i < ends.size(); ++i)
            if (elements->positions()(0, ends[i]) == 2.0) sum += solution.loads(3 * static_cast<Eigen::Index>(i), 0);
        EXPECT_NEAR(sum, force, 1e-8 * std::abs(force)) << stretch;
    }
}

TEST_P(BarOfDegree, SmallMotionsGiveTheLinearAnswerToSecondOrder) {
    const HeldBar bar({6, 2, 2}, GetParam());
    Control control;
    const Eigen::VectorXd shape = bar.bent(1.0);
    std::vector<double> differences;
    for (const double size : {1.0, 0.5, 0.25}) {
        const NodeSolution solution = bar.solve(size * shape);
        const NodeSolution linear = bar.solver->solve_task(
            {.prescribed = Eigen::VectorXd::Zero(shape.size()), .changes = size * shape}, 1e-8, control);
        differences.push_back((solution.displacements.col(0) - linear.displacements.col(1)).norm());
    }
    EXPECT_NEAR(differences[0] / differences[1], 4.0, 0.1);
    EXPECT_NEAR(differences[1] / differences[2], 4.0, 0.1);
}

TEST_P(BarOfDegree, ReactionsBalanceAtPresentPositions) {
    const HeldBar bar({6, 2, 2}, GetParam());
    const NodeSolution solution = bar.solve(bar.bent(100));
    Vector3d force = Vector3d::Zero(), moment = force;
    double size = 0.0;
    const std::vector<int>& nodes = bar.solver->nodes();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Vector3d f = solution.loads.col(0).segment<3>(3 * static_cast<Eigen::Index>(i));
        const Vector3d x =
            bar.elements->positions().col(nodes[i]) + solution.displacements.col(0).segment<3>(3 * nodes[i]);
        force += f;
        moment += x.cross(f);
        size += f.norm();
    }
    EXPECT_LT(force.norm(), 1e-8 * size);
    EXPECT_LT(moment.norm(), 1e-8 * size);
}

TEST_P(BarOfDegree, NewtonTakesAtMostFourIterationsToTheNextFiveDegrees) {
    const HeldBar bar({8, 2, 2}, GetParam());
    for (const double degrees : {0.0, 45.0, 90.0}) {
        const NodeSolution twisted = bar.solve(bar.twisted(degrees)), bent = bar.solve(bar.bent(degrees));
        EXPECT_LE(iterations(bar.solve(bar.twisted(degrees + 5), twisted.state.get())), 4) << degrees;
        EXPECT_LE(iterations(bar.solve(bar.bent(degrees + 5), bent.state.get())), 4) << degrees;
    }
}

TEST_P(BarOfDegree, AJumpOf120DegreesTakesAtMostThirtyIterations) {
    const HeldBar bar({8, 2, 2}, GetParam());
    const NodeSolution twisted = bar.solve(bar.twisted(120)), bent = bar.solve(bar.bent(120));
    EXPECT_LE(iterations(twisted), 30);
    EXPECT_LE(iterations(bent), 30);
    EXPECT_TRUE(twisted.state->facts().stable);
    // In steps, from one equilibrium to the next, the same is found.
    NodeSolution step = bar.solve(bar.twisted(30));
    for (const double degrees : {60.0, 90.0, 120.0}) step = bar.solve(bar.twisted(degrees), step.state.get());
    EXPECT_LT(rms(step.displacements, twisted.displacements), 1e-6);
}

/// What follows a hand is rough, by the tangent that is at hand for as long as it can be. Residuals hardly see the soft
/// motions of a slender bar: displacements are compared.
TEST_P(BarOfDegree, RoughEquilibriaThatFollowAHandAreCloseInSoftMotionsToo) {
    const HeldBar bar({24, 1, 1}, GetParam(), 0.3, 12.0);
    const auto end_at = [&](double degrees) {
        return bar.moved(rotation(Vector3d::UnitZ(), degrees), {6.0, 0.5, 0.5});
    };
    constexpr double kStep = 10.0;
    Control control;
    NodeSolution rough, exact = bar.solve(end_at(0.0));
    for (int i = 1; i <= 6; ++i) {
        const Eigen::VectorXd at = end_at(i * kStep), change = end_at((i + 1) * kStep) - at;
        const Eigen::VectorXd before = exact.displacements.col(0);
        const auto answer = [&](const NodeState* start, double tolerance) {
            return bar.solver->solve_task({.prescribed = at, .changes = change, .start = start}, tolerance, control);
        };
        rough = answer(rough.state.get(), 1e-3);
        exact = answer(exact.state.get(), 1e-10);
        const Eigen::VectorXd step = exact.displacements.col(0) - before;
        EXPECT_LT((rough.displacements.col(0) - exact.displacements.col(0)).norm(), 0.01 * step.norm()) << i;
        EXPECT_LT(rms(rough.displacements.col(1), exact.displacements.col(1)), 0.1) << i;
    }
}

TEST_P(BarOfDegree, TheTangentPredictsTheNextEquilibriumToSecondOrder) {
    const HeldBar bar({6, 2, 2}, GetParam());
    const Eigen::VectorXd at = bar.bent(60), change = bar.bent(61) - at;
    Control control;
    const NodeSolution start = bar.solver->solve_task({.prescribed = at, .changes = change}, 1e-8, control);
    std::vector<double> off;
    for (const double part : {1.0, 0.5}) {
        const NodeSolution next = bar.solve(at + part * change, start.state.get());
        off.push_back(
            (next.displacements.col(0) - start.displacements.col(0) - part * start.displacements.col(1)).norm());
    }
    EXPECT_LT(off[0], 0.05 * start.displacements.col(1).norm());
    EXPECT_NEAR(off[0] / off[1], 4.0, 0.3);
}

/// Whatever the end prescribes after two turns, the path tells them from rest.
TEST(NonlinearSolver, APathOfTwoTurnsEndsTwistedThoughItsEndIsThatOfRest) {
    const HeldBar bar({16, 2, 2}, ElementDegree::linear, 0.3, 8.0);
    Eigen::MatrixXd path(bar.twisted(0).size(), 8);
    for (Eigen::Index k = 0; k < path.cols(); ++k) path.col(k) = bar.twisted(80.0 * static_cast<double>(k + 1));
    Control control;
    const NodeSolution turned = bar.solver->solve_task({.prescribed = bar.twisted(720.0), .path = path}, 1e-8, control);
    EXPECT_TRUE(state_of(turned).converged);
    EXPECT_GT(turned.state->facts().energy, 0.5);
    EXPECT_LT(bar.solve(bar.twisted(0)).state->facts().energy, 1e-20);
    // And back.
    const NodeSolution back = bar.solver->solve_task(
        {.prescribed = bar.twisted(0.0), .start = turned.state.get(), .path = path.rowwise().reverse()}, 1e-8, control);
    EXPECT_LT(back.displacements.norm(), 1e-6);
}

/// Displacements of `bar`, twisted by 120 degrees, at the nodes of another one.
Eigen::VectorXd twisted_at(const HeldBar& bar, const FiniteElements& nodes) {
    return test::at_nodes(*bar.elements, bar.solve(bar.twisted(120)).displacements, nodes);
}

/// The clamped rims are singular, which no degree changes: this is as far as these meshes go.
TEST(NonlinearSolver, ABarTwistedBy120DegreesIsCloseToTheAnswerOfAFinerMesh) {
    const auto nodes = elements_of_box({4, 1, 1}, {4, 1, 1}, ElementDegree::quadratic);
    const Eigen::VectorXd medium = twisted_at(HeldBar({8, 2, 2}, ElementDegree::quadratic), *nodes),
                          fine = twisted_at(HeldBar({12, 3, 3}, ElementDegree::quadratic), *nodes),
                          truth = twisted_at(HeldBar({16, 4, 4}, ElementDegree::quadratic), *nodes);
    EXPECT_LT(rms(medium, truth), 3e-3);
    EXPECT_LT(rms(fine, truth), 1e-3);
}

/// All of the surface follows a smooth map.
Eigen::VectorXd smooth_answer(int cells, const FiniteElements& nodes) {
    const auto elements = elements_of_box({cells, cells, cells}, {1, 1, 1}, ElementDegree::quadratic);
    const std::vector<int> outside = test::nodes_where(
        *elements, [](const Vector3d& p) { return (p.array() == 0.0).any() || (p.array() == 1.0).any(); });
    Control control;
    const NonlinearSolver solver(elements, {1.0, 0.3}, {outside, 0, true}, control);
    Eigen::VectorXd values(3 * std::ssize(outside));
    for (std::size_t i = 0; i < outside.size(); ++i) {
        const Vector3d x = elements->positions().col(outside[i]);
        Vector3d moved = rotation(Vector3d::UnitZ(), 60 * x[2]) * x;
        moved[2] += 0.2 * std::sin(2.0 * x[0]) * x[2];
        values.segment<3>(3 * static_cast<Eigen::Index>(i)) = moved - x;
    }
    return test::at_nodes(*elements, solver.solve(values, false).displacements, nodes);
}

TEST(NonlinearSolver, TenNodesGiveDisplacementsOfThirdOrder) {
    const auto nodes = elements_of_box({2, 2, 2}, {1, 1, 1}, ElementDegree::linear);
    const Eigen::VectorXd coarse = smooth_answer(2, *nodes), medium = smooth_answer(4, *nodes),
                          fine = smooth_answer(8, *nodes);
    EXPECT_GT(std::log2((coarse - fine).norm() / (medium - fine).norm()), 2.7);
}

/// A slender bar that is compressed along its axis: the straight state is an equilibrium, and not stable.
TEST(NonlinearSolver, ACompressedBarBucklesRatherThanStaysStraight) {
    const HeldBar bar({10, 1, 1}, ElementDegree::quadratic, 0.3, 10.0);
    const NodeSolution solution = bar.solve(bar.moved(Matrix3d::Identity(), Vector3d::Zero(), {-1.0, 0.0, 0.0}));
    EXPECT_TRUE(solution.state->facts().stable);
    const Eigen::Matrix3Xd u = solution.displacements.col(0).reshaped(3, bar.elements->n_nodes());
    EXPECT_GT(u.bottomRows(2).cwiseAbs().maxCoeff(), 0.5);
}

/// A compressed bar, whose tangent is projected: four times as many steps as with the true one, unless fewer are
/// wanted.
TEST(NonlinearSolver, NewtonTakesNoMoreStepsThanAreWanted) {
    const HeldBar bar({8, 2, 2}, ElementDegree::quadratic);
    const Newton& newton = bar.solver->newton();
    NewtonWork work = newton.make_work();
    Control control;
    Eigen::VectorXd u = affine(*bar.elements, Vector3d(0.7, 1.0, 1.0).asDiagonal());
    for (Eigen::Index i = 0; i < u.size() / 3; ++i)
        u[3 * i + 1] += 0.02 * std::sin(std::numbers::pi * bar.elements->positions()(0, i) / 4.0);
    const auto steps = [&](int most) {
        return newton.run(u, Eigen::VectorXd(0), 1e-12, 2, work, control, nullptr, most).iterations;
    };
    EXPECT_GT(steps(kMostEquilibriumSteps), 3);
    EXPECT_EQ(steps(3), 3);
}

/// Half of the bar is prescribed as its mirror image.
TEST(NonlinearSolver, AHalfThatIsTurnedInsideOutHasNoEquilibriumAndSaysWhere) {
    const auto elements = elements_of_box({4, 2, 2}, {2, 1, 1}, ElementDegree::linear);
    std::vector<int> nodes = test::nodes_where(*elements, [](const auto& p) { return p[0] == 0.0; });
    const auto n_fixed = static_cast<Eigen::Index>(nodes.size());
    const std::vector<int> half = test::nodes_where(*elements, [](const auto& p) { return p[0] > 0.9; });
    nodes.insert(nodes.end(), half.begin(), half.end());
    Control control;
    const NonlinearSolver solver(elements, {1.0, 0.3}, {nodes, static_cast<int>(n_fixed), true}, control);
    Eigen::VectorXd values = Eigen::VectorXd::Zero(3 * std::ssize(nodes));
    for (Eigen::Index i = n_fixed; i < std::ssize(nodes); ++i)
        values[3 * i + 1] = 1.0 - 2.0 * elements->positions()(1, nodes[static_cast<std::size_t>(i)]);
    try {
        solver.solve(values, false);
        FAIL() << "an answer";
    } catch (const NoEquilibriumError& error) {
        EXPECT_TRUE(error.place().allFinite());
    }
}

/// One vertex is moved: the body follows as a whole, without strain.
TEST(NonlinearSolver, AFreeBodyFollowsOneVertex) {
    const auto elements = elements_of_box({2, 2, 2}, {1, 1, 1}, ElementDegree::quadratic);
    Control control;
    const NonlinearSolver solver(elements, {1.0, 0.3}, {{0}, 0, false}, control);
    const NodeSolution solution = solver.solve(Vector3d(0.3, -0.2, 0.1), true);
    EXPECT_LT(solution.state->facts().energy, 1e-10);
    EXPECT_FALSE(solver.held());
}

TEST(NonlinearSolver, CancellingStopsIt) {
    const HeldBar bar({4, 2, 2}, ElementDegree::linear);
    Control control;
    control.cancel();
    EXPECT_THROW(bar.solver->solve_task({.prescribed = bar.bent(60)}, 1e-8, control), Cancelled);
}

}  // namespace
}  // namespace elastolab
