#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <Eigen/Geometry>
#include <utility>

#include "bem/collocation/hierarchical.hpp"
#include "bem/collocation/method.hpp"
#include "bem/cost.hpp"
#include "bem/hierarchical/cases.hpp"
#include "bem/hierarchical/recycled_solutions.hpp"
#include "deform/gmres.hpp"
#include "deform/node_solver.hpp"
#include "mesh/primitives.hpp"
#include "mesh/refine.hpp"
#include "methods/problem.hpp"
#include "study/error/organic_body.hpp"

namespace elastolab::test {
namespace {

Method hierarchical_linear(Update update = Update::reduced, Tractions tractions = Tractions::discontinuous) {
    return {.kind = kLinearBem, .tractions = tractions, .update = update, .hierarchical_from = 0};
}
Method dense_linear(Tractions tractions = Tractions::discontinuous, Update update = Update::direct) {
    return {.kind = kLinearBem, .tractions = tractions, .update = update};
}

void expect_as_dense(const SurfaceMesh& mesh, const ConstrainedSet& set, const Eigen::VectorXd& values,
                     Tractions tractions) {
    Control control;
    std::vector<Deformer::Answer> answers;
    for (const Method& method : {dense_linear(tractions), hierarchical_linear(Update::direct, tractions)}) {
        Deformer deformer(precomputed(make_body(mesh), method));
        deformer.constrain(set, control);
        answers.push_back(deformer.answer(values, {.residual = true}, control));
    }
    EXPECT_LT(off(answers[1].displacements, answers[0].displacements), 1e-6);
    EXPECT_LT(off(answers[1].reactions.forces, answers[0].reactions.forces), 1e-4);
    EXPECT_LT(answers[1].residual.value(), 1e-7);
}

TEST(HierarchicalCollocation, AFurtherHandleOnAKeptBaseIsAnsweredAsByTheDenseMatrix) {
    const OrganicBody body = make_rabbit(500);
    const SurfaceMesh& mesh = body.surface;
    const Eigen::Vector3d low = mesh.vertices.rowwise().minCoeff(), high = mesh.vertices.rowwise().maxCoeff();
    std::vector<int> both = body.pull;
    for (int v = 0; v < mesh.n_vertices(); ++v)
        if (mesh.vertices(0, v) > low[0] + 0.93 * (high[0] - low[0]) &&
            std::ranges::find(body.fixed, v) == body.fixed.end() && std::ranges::find(both, v) == both.end())
            both.push_back(v);
    ASSERT_GT(both.size(), body.pull.size() + 3);
    const Eigen::VectorXd values = Eigen::Vector3d(0.1, -0.2, 0.15).replicate(std::ssize(both), 1);
    const Eigen::VectorXd exact = displaced(precomputed(make_body(mesh), dense_linear()), {body.fixed, both}, values);
    Control control;
    const auto boundary = std::make_shared<const Boundary>(mesh);
    const auto matrices = std::make_shared<const HierarchicalCollocation>(boundary, Material{1.0, 0.3}, 1e-10, control);
    const VertexTriangles around(mesh);
    const auto solver_of = [&](const std::vector<int>& held) {
        const TractionSpace space = linear_traction_space(*boundary, around, Tractions::discontinuous, held);
        return CollocationSolver(matrices, space, held, {}, true, control);
    };
    const CollocationSolver before = solver_of(joined(body.fixed, body.pull)),
                            after = solver_of(joined(body.fixed, both));
    const CollocationLoads &first = before.problem().loads(), &second = after.problem().loads();
    EXPECT_EQ(first.n_new_slots(), first.n_slots());
    EXPECT_GT(second.n_new_slots(), 0);
    EXPECT_LT(second.n_new_slots(), second.n_slots() / 2) << "what is kept is integrated again";
    Eigen::VectorXd prescribed = Eigen::VectorXd::Zero(3 * std::ssize(body.fixed) + values.size());
    prescribed.tail(values.size()) = values;
    EXPECT_LT(off(after.solve(prescribed, false).displacements, exact), 1e-6);
}

class HierarchicalCollocationTractions : public testing::TestWithParam<Tractions> {};

TEST_P(HierarchicalCollocationTractions, AgreesWithTheDenseMatrixOnAnOrganicBody) {
    const OrganicBody body = make_rabbit(600);
    const Positions moved = body.values(0.3).rightCols(std::ssize(body.pull));
    expect_as_dense(body.surface, {body.fixed, body.pull}, moved.reshaped(), GetParam());
}

INSTANTIATE_TEST_SUITE_P(All, HierarchicalCollocationTractions, testing::ValuesIn(kAllTractions),
                         [](const auto& its) { return std::string(name(its.param)); });

/// Vertices that are held alone carry whole hats; a patch of one triangle leaves its vertices without hats.
TEST(HierarchicalCollocation, LoneVerticesAndTrianglesAreHeldAsByTheDenseMatrix) {
    const SurfaceMesh mesh = make_sphere(10);
    ConstrainedSet set;
    set.fixed = vertices_where(mesh, [](const auto& x) { return x[2] < -0.8; });
    for (int t = 0; t < mesh.n_triangles() && set.handles.empty(); ++t) {
        const Eigen::Vector3i v = mesh.triangles.col(t);
        if (mesh.vertices(2, v).minCoeff() > 0.9) set.handles = {v[0], v[1], v[2]};
    }
    for (int v = 0; v < mesh.n_vertices() && set.handles.size() < 4; ++v)
        if (mesh.vertices(0, v) > 0.95) set.handles.push_back(v);
    ASSERT_EQ(set.handles.size(), 4u);
    Eigen::VectorXd values(12);
    values << 0.1, 0.0, 0.2, 0.1, 0.1, 0.2, 0.1, 0.0, 0.1, 0.3, 0.0, 0.0;
    expect_as_dense(mesh, set, values, Tractions::discontinuous);
}

TEST(HierarchicalCollocation, AHollowSphereIsPulledAsByTheDenseMatrix) {
    const SurfaceMesh mesh = make_hollow_sphere(7);
    ConstrainedSet set;
    set.fixed = vertices_where(mesh, [](const auto& x) { return x[2] < -0.7; });
    set.handles = vertices_where(mesh, [](const auto& x) { return x[2] > 0.8; });
    const Eigen::VectorXd pull = Eigen::Vector3d(0.1, 0.05, 0.2).replicate(std::ssize(set.handles), 1);
    expect_as_dense(mesh, set, pull, Tractions::discontinuous);
}

TEST(HierarchicalCollocation, IsExactForAStretchedBoxUpToIncompressibility) {
    expect_exact_for_a_stretched_box(6, [](Update update) { return hierarchical_linear(update); });
}

TEST(HierarchicalCollocation, ATurnedBodyCarriesNoForces) {
    expect_rigid_motion_without_force(make_rabbit(500).surface, hierarchical_linear(), 1e-5);
}

TEST(HierarchicalCollocation, ABodyThatIsNotHeldMovesAsByTheDenseMatrixOrIsRefused) {
    const SurfaceMesh mesh = make_sphere(9);
    Control control;
    Deformer direct(precomputed(make_body(mesh), hierarchical_linear(Update::direct)));
    EXPECT_THROW(direct.constrain({{}, {0}}, control), NotHeldError);
    // One vertex is followed; two that are pulled apart leave a turn about their line.
    const int last = mesh.n_vertices() - 1;
    Eigen::VectorXd apart(6);
    apart << -mesh.vertices.col(0), 0.4 * Eigen::Vector3d(mesh.vertices.col(0)) + mesh.vertices.col(last);
    for (const auto& [pulled, values] : {std::pair<std::vector<int>, Eigen::VectorXd>{{0}, Eigen::Vector3d(1, 2, 3)},
                                         std::pair<std::vector<int>, Eigen::VectorXd>{{0, last}, apart}}) {
        std::vector<Eigen::VectorXd> answers;
        for (const Method& method : {dense_linear(Tractions::discontinuous, Update::reduced), hierarchical_linear()}) {
            Deformer reduced(precomputed(make_body(mesh), method));
            reduced.constrain({{}, pulled}, control);
            EXPECT_FALSE(reduced.quality().held);
            answers.push_back(reduced.displace(values));
            EXPECT_LT((at(answers.back(), pulled) - values).norm(), 1e-9);
        }
        EXPECT_LT(off(answers[1], answers[0]), 1e-5) << pulled.size();
    }
}

struct CubeProblem {
    SurfaceMesh mesh;
    std::shared_ptr<const HierarchicalCollocation> matrices;
    std::unique_ptr<const CollocationProblem> problem;

    CubeProblem(SurfaceMesh surface, double poisson_ratio) : mesh(std::move(surface)) {
        auto boundary = std::make_shared<const Boundary>(mesh);
        matrices =
            std::make_shared<const HierarchicalCollocation>(boundary, Material{1.0, poisson_ratio}, 1e-10, control);
        auto held = vertices_where(mesh, [](const auto& x) {
            return x[0] < 1e-9 || (x[0] > 1.0 - 1e-9 && x[1] > 0.6) || (x[2] > 1.0 - 1e-9 && x[1] < 1e-9);
        });
        const TractionSpace space =
            linear_traction_space(*boundary, VertexTriangles(mesh), Tractions::discontinuous, held);
        EXPECT_FALSE(space.interior_triangles.empty());
        n_held = static_cast<int>(held.size());
        problem = std::make_unique<const CollocationProblem>(matrices, space, std::move(held),
                                                             std::span<const UnitLoad>{}, true, control);
    }
    /// Iterations of a solve with all constrained vertices moved at random.
    int iterations() {
        const auto preconditioner = make_collocation_preconditioner(*problem, control);
        IterationReport report;
        gmres(*problem, *preconditioner, problem->right_side(Eigen::MatrixXd::Random(3 * n_held, 1)), {}, "test",
              control, &report);
        return report.iterations;
    }

    Control control;
    int n_held = 0;
};

TEST(HierarchicalCollocation, BlocksOfThePreconditionerAreThoseOfTheMatrix) {
    const CubeProblem cube(make_box(6), 0.3);
    const CollocationProblem& A = *cube.problem;
    std::vector<int> numbers;  // free vertices, hats, corners of triangles by themselves
    for (int i = 0; i < A.n_free() + A.n_slots(); i += 5) numbers.push_back(i);
    ASSERT_LT(numbers.front(), A.n_free());
    ASSERT_GT(numbers.back(), A.n_free());
    const Eigen::MatrixXd block = A.block(numbers);
    std::vector<Eigen::Index> rows;
    for (const int number : numbers)
        for (int k = 0; k < 3; ++k) rows.push_back(3 * number + k);
    Eigen::MatrixXd units = Eigen::MatrixXd::Zero(A.size(), std::ssize(rows));
    for (std::size_t c = 0; c < rows.size(); ++c) units(rows[c], static_cast<Eigen::Index>(c)) = 1.0;
    const Eigen::MatrixXd columns = A.product(units);
    EXPECT_LT((columns(rows, Eigen::all) - block).cwiseAbs().maxCoeff(), 1e-5 * block.cwiseAbs().maxCoeff());
}

TEST(HierarchicalCollocation, ColumnsWithFewEntriesAreMultipliedAsOthers) {
    const CubeProblem cube(make_box(6), 0.3);
    const CollocationProblem& A = *cube.problem;
    std::vector<Eigen::Triplet<double>> entries;  // the last columns are tractions alone
    for (int i = 0; i < A.size(); ++i) entries.emplace_back(i, i / 40, 1.0 + 0.1 * (i % 7));
    SparseColumns Z(A.size(), A.size() / 40 + 1);
    Z.setFromTriplets(entries.begin(), entries.end());
    Control control;
    const Eigen::MatrixXd truth = A.product(Eigen::MatrixXd(Z));
    EXPECT_LT(off(A.sparse_product(Z, control), truth), 1e-9);
}

TEST(HierarchicalCollocation, TakesAFewIterationsWhateverTheSizesOfTriangles) {
    EXPECT_LE(CubeProblem(make_box(8), 0.3).iterations(), 14);
    EXPECT_LE(CubeProblem(make_box(8), 0.5).iterations(), 20);
    // A corner of triangles some thirty times smaller than their neighbours.
    RefinedSurface graded = unrefined(make_box(6));
    for (int round = 0; round < 5; ++round) {
        std::vector<char> marked;
        for (const auto& triangle : graded.mesh.triangles.colwise()) {
            const Eigen::Vector3d middle = graded.mesh.vertices(Eigen::all, Eigen::Vector3i(triangle)).rowwise().mean();
            marked.push_back((middle - Eigen::Vector3d(0.5, 1.0, 1.0)).norm() < 0.12);
        }
        graded = refine_marked(graded, marked);
        if (graded.mesh.n_vertices() > 2500) break;
    }
    EXPECT_LE(CubeProblem(graded.mesh, 0.3).iterations(), 30) << graded.mesh.n_vertices() << " vertices";
}

TEST(HierarchicalCollocation, IsChosenForLargeSurfacesOnDemandAndCancelled) {
    // 1260 and 3500 vertices.
    const SurfaceMesh small = make_torus(15), large = make_torus(25);
    const Method direct{.kind = kLinearBem, .update = Update::direct}, reduced{.kind = kLinearBem},
        eqn9{.kind = kLinearBem, .update = Update::eqn9}, full{.kind = kLinearBem, .mode = Mode::full};
    EXPECT_FALSE(is_hierarchical(small, direct));
    EXPECT_FALSE(is_hierarchical(small, reduced));
    EXPECT_TRUE(is_hierarchical(large, direct));
    EXPECT_TRUE(is_hierarchical(large, reduced));
    EXPECT_FALSE(is_hierarchical(large, eqn9));
    EXPECT_FALSE(is_hierarchical(large, full));
    const std::uint64_t bytes = kLinearBem->predict(large, reduced).memory_bytes;
    const auto n = static_cast<std::uint64_t>(large.n_vertices());
    EXPECT_LT(bytes, 72 * n * n / 2);
    Control control;
    const Method of_small{.kind = kLinearBem, .update = Update::direct, .hierarchical_from = 1000};
    ASSERT_TRUE(is_hierarchical(small, of_small));
    const auto model = kLinearBem->precompute(small, "torus", 0.3, of_small, nullptr, control);
    EXPECT_GT(model->facts().memory_bytes, 0u) << "the hierarchical matrix is made ahead";
    EXPECT_LT(model->facts().memory_bytes, kLinearBem->predict(small, of_small).memory_bytes);
    control.cancel();
    const std::array held = {0, 1, 2, 3};
    EXPECT_THROW(model->constrain(held, {}, {}, control), Cancelled);
}

TEST(RecycledSolutions, ACombinationOfRightHandSidesIsNotComputed) {
    RecycledSolutions kept;
    int computed = 0;
    const Eigen::MatrixXd map = Eigen::MatrixXd::Random(5, 3);
    const auto compute = [&](const Eigen::MatrixXd& questions, const Eigen::MatrixXd&) -> Eigen::MatrixXd {
        computed += static_cast<int>(questions.cols());
        return map * questions;
    };
    EXPECT_EQ(kept.get(Eigen::Vector3d::Zero(), 5, 1e-8, compute).norm(), 0.0);
    EXPECT_EQ(computed, 0);
    kept.get(Eigen::Vector3d(1.0, 2.0, 0.0), 5, 1e-8, compute);
    kept.get(Eigen::Vector3d(0.0, 1.0, 0.0), 5, 1e-8, compute);
    EXPECT_EQ(computed, 2);
    const Eigen::Vector3d combination(3.0, -1.0, 0.0), other(0.0, 0.0, 1.0);
    Eigen::MatrixXd both(3, 2);
    both << combination, other;
    const Eigen::MatrixXd answers = kept.get(both, 5, 1e-8, compute);
    EXPECT_EQ(computed, 3);
    EXPECT_LT((answers - map * both).norm(), 1e-12);
    const Eigen::Vector3d nothing = Eigen::Vector3d::Constant(std::nan(""));
    EXPECT_FALSE(kept.get(nothing, 5, 1e-8, compute).allFinite()) << "is computed";
    EXPECT_EQ(computed, 4);
    for (int i = 0; i < 40; ++i) kept.get(Eigen::Vector3d(1.0, 0.1 * i, 2.0), 5, 1e-8, compute);
    EXPECT_EQ(computed, 4) << "three answers span all questions";
}

TEST(RecycledSolutions, OfManyAtOnceNoneIsKept) {
    constexpr int kMany = 40;
    RecycledSolutions kept;
    int computed = 0;
    const auto twice = [&](const Eigen::MatrixXd& questions, const Eigen::MatrixXd&) -> Eigen::MatrixXd {
        computed += static_cast<int>(questions.cols());
        return 2.0 * questions;
    };
    const Eigen::MatrixXd many = Eigen::MatrixXd::Identity(kMany, kMany);
    EXPECT_EQ(kept.get(many, kMany, 1e-8, twice), 2.0 * many);
    const Eigen::VectorXd one = many.col(3), other = many.col(4);
    EXPECT_EQ(kept.get(one, kMany, 1e-8, twice), 2.0 * one);
    EXPECT_EQ(computed, kMany + 1);
    EXPECT_LT((kept.get(-one, kMany, 1e-8, twice) + 2.0 * one).norm(), 1e-12) << "is known";
    EXPECT_EQ(computed, kMany + 1);
    EXPECT_EQ(kept.get(other, kMany, 1e-8, twice), 2.0 * other);
}

TEST(RecycledSolutions, NearlyParallelRightHandSidesDoNotAmplifyErrors) {
    constexpr double kTolerance = 1e-8;
    for (const double angle : {1e-2, 1e-4, 1e-6}) {
        RecycledSolutions kept;
        // Solutions of x = b that are as wrong as the tolerance allows, in a direction of their own each time.
        int computed = 0;
        const auto nearly = [&](const Eigen::MatrixXd& sides, const Eigen::MatrixXd&) -> Eigen::MatrixXd {
            Eigen::MatrixXd answers = sides;
            for (Eigen::Index c = 0; c < sides.cols(); ++c)
                answers.col(c)[computed++ % 3] += kTolerance * sides.col(c).norm();
            return answers;
        };
        kept.get(Eigen::Vector3d(1.0, 0.0, 0.0), 3, kTolerance, nearly);
        kept.get(Eigen::Vector3d(1.0, angle, 0.0), 3, kTolerance, nearly);
        const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
        EXPECT_LT((kept.get(y, 3, kTolerance, nearly) - y).norm(), 10.0 * kTolerance) << angle;
    }
}

TEST(RecycledSolutions, WhatIsKnownLessExactlyIsAStart) {
    RecycledSolutions kept;
    std::vector<Eigen::Vector3d> starts;
    const auto twice = [&](double error) {
        return [&starts, error](const Eigen::MatrixXd& questions, const Eigen::MatrixXd& start) -> Eigen::MatrixXd {
            for (Eigen::Index c = 0; c < start.cols(); ++c) starts.emplace_back(start.col(c));
            return (2.0 + error) * questions;
        };
    };
    const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
    kept.get(x, 3, 1e-4, twice(1e-4));
    kept.get(y, 3, 1e-8, twice(0.0));
    ASSERT_EQ(starts.size(), 2u);
    EXPECT_EQ(starts[0], Eigen::Vector3d::Zero()) << "nothing is known";
    EXPECT_LT((kept.get(3.0 * x, 3, 1e-4, twice(0.0)) - 6.0003 * x).norm(), 1e-9);
    EXPECT_LT((kept.get(y, 3, 1e-4, twice(0.0)) - 2.0 * y).norm(), 1e-9) << "more exact than it need be";
    EXPECT_EQ(starts.size(), 2u);
    EXPECT_LT((kept.get(3.0 * x, 3, 1e-8, twice(0.0)) - 6.0 * x).norm(), 1e-9);
    ASSERT_EQ(starts.size(), 3u);
    EXPECT_LT((starts[2] - 6.0003 * x).norm(), 1e-9);
    EXPECT_LT((kept.get(x, 3, 1e-4, twice(0.0)) - 2.0 * x).norm(), 1e-9) << "the best that is known";
    EXPECT_EQ(starts.size(), 3u);
}

TEST(HierarchicalCollocation, AnswersToALooserToleranceFirstAndGoesOnFromThere) {
    expect_first_answer_and_the_rest(dense_linear(), hierarchical_linear());
}

}  // namespace
}  // namespace elastolab::test
