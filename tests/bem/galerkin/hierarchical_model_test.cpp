#include <gtest/gtest.h>

#include <cstdint>
#include <Eigen/Geometry>
#include <utility>

#include "bem/cost.hpp"
#include "bem/galerkin/error_estimate.hpp"
#include "bem/galerkin/hierarchical_model.hpp"
#include "bem/galerkin/method.hpp"
#include "bem/hierarchical/cases.hpp"
#include "deform/node_solver.hpp"
#include "mesh/primitives.hpp"
#include "methods/problem.hpp"
#include "study/error/organic_body.hpp"

namespace elastolab::test {
namespace {

Method hierarchical(Update update = Update::reduced) {
    return {.kind = kGalerkinBem, .update = update, .hierarchical_from = 0};
}
Method dense() { return {.kind = kGalerkinBem, .update = Update::direct}; }

TEST(HierarchicalGalerkin, AgreesWithTheDenseMatrixOnAnOrganicBody) {
    const OrganicBody body = make_rabbit(500);
    const ConstrainedSet set{body.fixed, body.pull};
    const Positions moved = body.values(0.3).rightCols(std::ssize(body.pull));
    const Eigen::VectorXd values = Eigen::Map<const Eigen::VectorXd>(moved.data(), moved.size());
    Control control;
    std::vector<Deformer::Answer> answers;
    for (const Method& method : {dense(), hierarchical()}) {
        Deformer deformer(precomputed(make_body(body.surface), method));
        deformer.constrain(set, control);
        answers.push_back(deformer.answer(values, {.residual = true}, control));
    }
    EXPECT_LT(off(answers[1].displacements, answers[0].displacements), 1e-6);
    EXPECT_LT(off(answers[1].reactions.forces, answers[0].reactions.forces), 1e-4);
    EXPECT_LT(answers[1].residual.value(), 1e-6);
    const Reactions& reactions = answers[1].reactions;
    EXPECT_LT(reactions.forces.rowwise().sum().norm(), 1e-6 * reactions.forces.colwise().norm().sum());
    EXPECT_LT(reactions.moments.rowwise().sum().norm(), 1e-6 * reactions.moments.colwise().norm().sum());
}

TEST(HierarchicalGalerkin, AFurtherHandleOnAKeptBaseIsAnsweredAsByTheDenseMatrix) {
    const OrganicBody body = make_rabbit(450);
    const Positions moved = body.values(0.3).rightCols(std::ssize(body.pull));
    const Eigen::VectorXd values = moved.reshaped();
    const Eigen::VectorXd exact =
        displaced(precomputed(make_body(body.surface), dense()), {body.fixed, body.pull}, values);
    StageTimes stages;
    Control control;
    const auto system = std::make_shared<const HierarchicalSystem>(body.surface, 0.3, hierarchical(), stages, control);
    const auto solver_of = [&](const std::vector<int>& vertices) {
        const GalerkinTractions tractions(body.surface, system->surfaces(), vertices);
        return HierarchicalSolver(system, vertices, tractions, {}, true, control);
    };
    const HierarchicalSolver before = solver_of(body.fixed), after = solver_of(joined(body.fixed, body.pull));
    EXPECT_GT(before.layers().n_new_triangles(), 0);
    EXPECT_GT(after.layers().n_new_triangles(), 0);
    EXPECT_EQ(3 * (before.layers().n_new_triangles() + after.layers().n_new_triangles()), after.layers().size())
        << "the fixed set is integrated again";
    Eigen::VectorXd prescribed = Eigen::VectorXd::Zero(3 * std::ssize(body.fixed) + values.size());
    prescribed.tail(values.size()) = values;
    EXPECT_LT(off(after.solve(prescribed, false).displacements, exact), 1e-6);
}

TEST(HierarchicalGalerkin, AgreesWithTheDenseMatrixWhereTractionsAreIteratedToo) {
    const SurfaceMesh mesh = make_box(8);
    const auto held = vertices_where(mesh, [](const auto& x) { return x[0] < 0.9; });
    const auto pulled = vertices_where(mesh, [](const auto& x) { return x[0] > 1.0 - 1e-9 && x[1] > 0.6; });
    const Eigen::Vector3d pull(0.2, 0.1, -0.1);
    Control control;
    Deformer exact(precomputed(make_body(mesh), dense()));
    exact.constrain({held, pulled}, control);
    const Deformer::Answer truth = exact.answer(pull.replicate(std::ssize(pulled), 1), {}, control);

    StageTimes stages;
    const auto system = std::make_shared<const HierarchicalSystem>(mesh, 0.3, hierarchical(), stages, control);
    const std::vector<int> vertices = joined(held, pulled);
    const GalerkinTractions tractions(mesh, system->surfaces(), vertices);
    const HierarchicalSolver solver(system, vertices, tractions, {}, true, control, 0);
    Eigen::MatrixXd prescribed = Eigen::MatrixXd::Zero(3, std::ssize(vertices));
    for (std::size_t i = 0; i < vertices.size(); ++i)
        if (std::ranges::count(pulled, vertices[i]) > 0) prescribed.col(static_cast<Eigen::Index>(i)) = pull;
    const NodeSolution solution = solver.solve(prescribed.reshaped(), true);
    EXPECT_LT(off(solution.displacements, truth.displacements), 1e-6);
    EXPECT_LT(off(solution.loads.topRows(prescribed.size()), truth.reactions.forces.reshaped()), 1e-4);
}

/// Nothing is left to move.
TEST(HierarchicalGalerkin, SolvesABodyWhoseVerticesAreAllPrescribed) {
    const SurfaceMesh mesh = make_box(6);
    const auto all = vertices_where(mesh, [](const auto&) { return true; });
    const Positions stretched = Eigen::Vector3d(1.0, -0.3, -0.3).asDiagonal() * mesh.vertices;
    const Eigen::VectorXd values = stretched.reshaped();
    Control control;
    for (const Update update : {Update::direct, Update::reduced}) {
        Deformer deformer(precompute(make_body(mesh), hierarchical(update), control));
        deformer.constrain({{}, all}, control);
        const Deformer::Answer answer = deformer.answer(values, {.residual = true, .check = true}, control);
        EXPECT_EQ(answer.displacements, values);
        EXPECT_LT(*answer.residual, 1e-4);
        double pull = 0.0;
        for (int v = 0; v < mesh.n_vertices(); ++v)
            if (mesh.vertices(0, v) > 1.0 - 1e-9) pull += answer.reactions.forces(0, v);
        EXPECT_NEAR(pull, 1.0, 1e-4) << "a unit stretch of a unit square";
    }
}

/// On a surface that is above the size of dense matrices.
TEST(HierarchicalGalerkin, GivesTheSecondAnswerThatEstimatesAreMadeOf) {
    const SurfaceMesh mesh = make_box(8);
    Method method = dense();
    method.hierarchical_from = 300;
    ASSERT_TRUE(is_hierarchical(mesh, method));
    const auto ends = vertices_where(mesh, [](const auto& x) { return x[0] < 1e-9 || x[0] > 1.0 - 1e-9; });
    const Positions stretched = Eigen::Vector3d(1.0, -0.3, -0.3).asDiagonal() * mesh.vertices;
    const Eigen::VectorXd values = stretched(Eigen::all, ends).reshaped();
    EXPECT_GT(galerkin_reference_memory(mesh, method, ends), 0u);
    Control control;
    const auto answer = galerkin_reference(mesh, method, 0.3, ends, {}, values, stretched.reshaped(), control);
    ASSERT_TRUE(answer);
    EXPECT_LT(off(answer->displacements, stretched.reshaped()), 1e-5);
    double pull = 0.0;
    for (std::size_t i = 0; i < ends.size(); ++i)
        if (mesh.vertices(0, ends[i]) > 0.5) pull += answer->reactions.forces(0, static_cast<Eigen::Index>(i));
    EXPECT_NEAR(pull, 1.0, 1e-4) << "a unit stretch of a unit square";
}

TEST(HierarchicalGalerkin, IsExactForAStretchedBox) { expect_exact_for_a_stretched_box(6, hierarchical); }

TEST(HierarchicalGalerkin, RigidMotionsCauseNoForceAndCavitiesFollow) {
    for (const SurfaceMesh& mesh : {make_rabbit(400).surface, make_hollow_sphere(6)})
        expect_rigid_motion_without_force(mesh, hierarchical(), 1e-6);
}

TEST(HierarchicalGalerkin, AHollowSphereIsPulledAsByTheDenseMatrix) {
    const SurfaceMesh mesh = make_hollow_sphere(7);
    ConstrainedSet set;
    set.fixed = vertices_where(mesh, [](const auto& x) { return x[2] < -0.7; });
    set.handles = vertices_where(mesh, [](const auto& x) { return x[2] > 0.8; });
    const Eigen::VectorXd pull = Eigen::Vector3d(0.1, 0.05, 0.2).replicate(std::ssize(set.handles), 1);
    const Eigen::VectorXd truth = displaced(precomputed(make_body(mesh), dense()), set, pull);
    EXPECT_LT(off(displaced(precomputed(make_body(mesh), hierarchical()), set, pull), truth), 1e-6);
}

/// `mesh` with a cavity around `middle`, of this shape.
void add_cavity(SurfaceMesh& mesh, SurfaceMesh cavity, const Eigen::Vector3d& middle) {
    const int n = mesh.n_vertices();
    cavity.triangles.row(1).swap(cavity.triangles.row(2));  // its normals point into it
    Positions vertices(3, n + cavity.n_vertices());
    vertices << mesh.vertices, cavity.vertices.colwise() + middle;
    Triangles triangles(3, mesh.n_triangles() + cavity.n_triangles());
    triangles << mesh.triangles, (cavity.triangles.array() + n).matrix();
    mesh.vertices = std::move(vertices);
    mesh.triangles = std::move(triangles);
}

SurfaceMesh tetrahedron(double size) {
    SurfaceMesh mesh;
    mesh.vertices = size * (Positions(3, 4) << 1, -1, -1, 1, 1, -1, 1, -1, 1, 1, -1, -1).finished();
    mesh.triangles = (Triangles(3, 4) << 0, 0, 0, 1, 2, 1, 3, 3, 1, 3, 2, 2).finished();
    return mesh;
}

/// Such a small closed surface is all within one subdomain of the preconditioner, where the hypersingular operator
/// annihilates its rigid motions.
TEST(HierarchicalGalerkin, SmallCavitiesAreAnsweredAsByTheDenseMatrix) {
    struct Case {
        const char* name;
        std::vector<SurfaceMesh> cavities;
    };
    const SurfaceMesh octahedron = make_sphere(1, 0.1), of_18 = make_sphere(2, 0.1), of_66 = make_sphere(4, 0.1);
    for (const Case& its : {Case{"4 vertices", {tetrahedron(0.05)}}, Case{"6", {octahedron}}, Case{"18", {of_18}},
                            Case{"66", {of_66}}, Case{"four", {tetrahedron(0.05), octahedron, of_18, of_66}}}) {
        SurfaceMesh mesh = make_sphere(7);
        double x = -0.45;
        for (const SurfaceMesh& cavity : its.cavities) {
            add_cavity(mesh, cavity, {x, 0.1, 0.2});
            x += 0.3;
        }
        ConstrainedSet set;
        set.fixed = vertices_where(mesh, [](const auto& p) { return p[2] < -0.7; });
        set.handles = vertices_where(mesh, [](const auto& p) { return p[2] > 0.8; });
        const Eigen::VectorXd pull = Eigen::Vector3d(0.1, 0.05, 0.2).replicate(std::ssize(set.handles), 1);
        const Eigen::VectorXd truth = displaced(precomputed(make_body(mesh), dense()), set, pull);
        EXPECT_LT(off(displaced(precomputed(make_body(mesh), hierarchical()), set, pull), truth), 1e-6) << its.name;
    }
}

TEST(HierarchicalGalerkin, ABodyThatIsNotHeldMovesLeastOrIsRefused) {
    const SurfaceMesh mesh = make_sphere(8);
    const Eigen::Vector3d pull(1.0, 2.0, 3.0);
    Control control;
    Deformer direct(precomputed(make_body(mesh), hierarchical(Update::direct)));
    EXPECT_THROW(direct.constrain({{}, {0}}, control), NotHeldError);
    Deformer reduced(precomputed(make_body(mesh), hierarchical()));
    reduced.constrain({{}, {0}}, control);
    EXPECT_FALSE(reduced.quality().held);
    const Eigen::VectorXd u = reduced.displace(pull);
    EXPECT_LT((u.head<3>() - pull).norm(), 1e-9);
    // It turns about the vertex rather than being carried along: no rotation makes the sum of squares smaller.
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();
    for (int v = 0; v < mesh.n_vertices(); ++v)
        turn +=
            Eigen::Vector3d(mesh.vertices.col(v) - mesh.vertices.col(0)).cross(Eigen::Vector3d(u.segment<3>(3 * v)));
    EXPECT_LT(turn.norm(), 1e-6 * u.norm() * mesh.vertices.norm());
}

TEST(HierarchicalGalerkin, KeepsAnswersForCombinationsOfThem) {
    const OrganicBody body = make_rabbit(400);
    Control control;
    Deformer deformer(precomputed(make_body(body.surface), hierarchical()));
    deformer.constrain({body.fixed, body.pull}, control);
    const Eigen::Index n = std::ssize(body.pull);
    const Eigen::MatrixXd basis = Eigen::Matrix3d::Identity().replicate(n, 1);
    const DragResponse drag = deformer.drag_response(Eigen::VectorXd::Zero(3 * n), basis, control);
    const Eigen::Vector3d pull(0.1, -0.3, 0.2);
    Eigen::VectorXd u;
    drag.displace(pull, u);
    // A cancelled control stops every iteration: this answer needs none, another motion does.
    control.cancel();
    EXPECT_LT(off(deformer.displace(basis * pull, control), u), 1e-9);
    EXPECT_THROW(deformer.displace(Eigen::VectorXd::LinSpaced(3 * n, 0.0, 1.0), control), Cancelled);
}

TEST(HierarchicalGalerkin, AnswersToALooserToleranceFirstAndGoesOnFromThere) {
    expect_first_answer_and_the_rest(dense(), hierarchical());
}

TEST(HierarchicalGalerkin, IsChosenForLargeSurfacesOnDemand) {
    // 1260 and 3500 vertices.
    const SurfaceMesh small = make_torus(15), large = make_torus(25);
    const Method direct = dense(), reduced{.kind = kGalerkinBem}, full{.kind = kGalerkinBem, .mode = Mode::full};
    EXPECT_FALSE(is_hierarchical(small, direct));
    EXPECT_FALSE(is_hierarchical(small, reduced));
    EXPECT_TRUE(is_hierarchical(large, direct));
    EXPECT_TRUE(is_hierarchical(large, reduced));
    EXPECT_FALSE(is_hierarchical(large, full));
    // Less than the dense matrix alone, and growing as the surface does.
    const std::uint64_t bytes = kGalerkinBem->predict(large, reduced).memory_bytes;
    const auto n = static_cast<std::uint64_t>(large.n_vertices());
    EXPECT_LT(bytes, 72 * n * n / 2);
    EXPECT_LT(kGalerkinBem->predict(make_torus(50), reduced).memory_bytes, 6 * bytes);
    EXPECT_GT(kGalerkinBem->predict(large, direct).seconds(), 0.0);
}

TEST(HierarchicalGalerkin, TakesOverTheMatrixForAnotherUpdate) {
    const Body body = make_body(make_rabbit(300).surface);
    Control control;
    const auto first = precomputed(body, hierarchical(Update::direct));
    const auto second = precompute_again(*first, body.material, hierarchical(), control);
    EXPECT_TRUE(second->facts().stages.empty());
    EXPECT_GT(second->facts().memory_bytes, 0u);
}

}  // namespace
}  // namespace elastolab::test
