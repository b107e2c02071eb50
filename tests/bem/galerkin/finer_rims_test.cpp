// Galerkin BEM with rows of thin triangles along the rims of the constrained patches.
#include "bem/galerkin/finer_rims.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "bem/galerkin/cost.hpp"
#include "bem/galerkin/error_estimate.hpp"
#include "bem/galerkin/hypersingular.hpp"
#include "bem/galerkin/method.hpp"
#include "bem/galerkin/refined_hypersingular.hpp"
#include "bem/galerkin/slender_bar.hpp"
#include "bem/galerkin/solvers.hpp"
#include "bem/hierarchical/cases.hpp"
#include "elasticity/rigid_motion.hpp"
#include "mesh/meshes.hpp"
#include "mesh/primitives.hpp"
#include "methods/problem.hpp"
#include "study/error/organic_body.hpp"

namespace elastolab::test {
namespace {

Method with_rims(int rows, Update update = Update::reduced) {
    return {.kind = kGalerkinBem, .update = update, .rims = rows};
}

/// A rabbit that is held and pulled, and pressed on some free triangles in its middle.
struct PulledRabbit {
    OrganicBody body = make_rabbit(150);
    ConstrainedSet set{body.fixed, body.pull};
    Eigen::VectorXd values;

    PulledRabbit() {
        std::vector<char> constrained(static_cast<std::size_t>(body.surface.n_vertices()), 0);
        for (const auto* some : {&body.fixed, &body.pull})
            for (const int v : *some) constrained[static_cast<std::size_t>(v)] = 1;
        std::vector<int> free;
        for (int t = 0; t < body.surface.n_triangles(); ++t) {
            bool is_free = true;
            for (const int v : body.surface.triangles.col(t)) is_free &= !constrained[static_cast<std::size_t>(v)];
            if (is_free && t % 3 == 0) free.push_back(t);
        }
        set.loads = {body_force_along(2), unit_pressure(body.surface, free)};
        const Positions moved = body.values(0.3).rightCols(std::ssize(body.pull));
        values.resize(moved.size() + 2);
        values << moved.reshaped(), -0.02, 0.05;
    }
    Deformer deformer(const Method& method) const {
        Control control;
        Deformer its(precomputed(make_body(body.surface), method));
        its.constrain(set, control);
        return its;
    }
    Deformer::Answer answer(const Method& method, Deformer::Wanted wanted = {}) const {
        Control control;
        return deformer(method).answer(values, wanted, control);
    }
};

TEST(FinerRims, HaveTheHypersingularOperatorOfTheirSurface) {
    const OrganicBody body = make_rabbit(200);
    Control control;
    const double tolerance = 1e-8;
    const Material material{1.0, 0.3};
    Eigen::MatrixXd coarse(3 * body.surface.n_vertices(), 3 * body.surface.n_vertices());
    assemble_hypersingular(Boundary(body.surface), material, tolerance, coarse, control);
    for (const int rows : {1, 2}) {
        const FinerRims rims(body.surface, body.fixed, {}, rows, LoneVertices::kept);
        const SurfaceMesh& fine = rims.surface.mesh;
        EXPECT_GT(fine.n_vertices(), body.surface.n_vertices());
        const auto boundary = std::make_shared<const Boundary>(fine);
        Eigen::MatrixXd expected(3 * fine.n_vertices(), 3 * fine.n_vertices());
        assemble_hypersingular(*boundary, material, tolerance, expected, control);
        const Eigen::MatrixXd D = refined_hypersingular(
            coarse, rims.surface, std::make_shared<const BoundaryPairs>(boundary, tolerance), material, control);
        EXPECT_LT((D - expected).norm(), 1e-7 * expected.norm()) << rows;
        EXPECT_EQ((D - D.transpose()).norm(), 0.0) << rows;
    }
}

/// What the method answers is what it answers on the finer surface itself, with what is prescribed linear on the
/// triangles of the body.
TEST(FinerRims, AnswerAsTheFinerSurfaceItself) {
    const PulledRabbit rabbit;
    Control control;
    for (const int rows : {1, 2}) {
        const auto vertices = joined(rabbit.body.fixed, rabbit.body.pull);
        const FinerRims rims(rabbit.body.surface, vertices, rabbit.set.loads, rows, LoneVertices::kept);
        Eigen::Matrix3Xd moved = Eigen::Matrix3Xd::Zero(3, rabbit.body.surface.n_vertices());
        for (std::size_t i = 0; i < rabbit.body.pull.size(); ++i)
            moved.col(rabbit.body.pull[i]) = rabbit.values.segment<3>(3 * static_cast<Eigen::Index>(i));
        Eigen::VectorXd values(3 * std::ssize(rims.vertices) + 2);
        values << rims.surface.interpolate(moved)(Eigen::all, rims.vertices).reshaped(), rabbit.values.tail(2);
        Deformer fine(
            precomputed(make_body(rims.surface.mesh), Method{.kind = kGalerkinBem, .update = Update::direct}));
        fine.constrain({{}, rims.vertices, rims.loads}, control);
        const Deformer::Answer expected = fine.answer(values, {}, control);
        const Deformer::Answer answer = rabbit.answer(with_rims(rows), {.residual = true});
        const Eigen::VectorXd there = expected.displacements.head(answer.displacements.size());
        EXPECT_LT(off(answer.displacements, there), 1e-5) << rows;  // the middle of the body differs by rounding
        EXPECT_LT((answer.reactions.forces.rowwise().sum() - expected.reactions.forces.rowwise().sum()).norm(),
                  1e-6 * expected.reactions.forces.colwise().norm().sum())
            << rows;
        EXPECT_LT((answer.reactions.moments.rowwise().sum() - expected.reactions.moments.rowwise().sum()).norm(),
                  1e-5 * expected.reactions.moments.colwise().norm().sum())
            << rows;
        EXPECT_LT(answer.residual.value(), 1e-8) << rows;
    }
}

TEST(FinerRims, AnswerTheSameByHierarchicalMatrices) {
    const PulledRabbit rabbit;
    Method method = with_rims(1);
    method.hierarchical_from = 0;
    const Deformer::Answer hierarchical = rabbit.answer(method, {.residual = true}),
                           dense = rabbit.answer(with_rims(1));
    EXPECT_LT(off(hierarchical.displacements, dense.displacements), 1e-6);
    EXPECT_LT(off(hierarchical.reactions.forces, dense.reactions.forces), 1e-4);
    EXPECT_LT(hierarchical.residual.value(), 1e-6);
}

TEST(FinerRims, AreExactForAStretchedBox) {
    for (const double nu : {0.0, 0.3, 0.5})
        for (const int rows : {1, 2, 3}) {
            if ((rows == 2 && nu != 0.3) || (rows == 3 && nu != 0.5)) continue;    // they take longest
            const SurfaceMesh mesh = make_box(rows < 3 ? 2 : 1, {2.0, 1.0, 1.0});  // of one cell: all are constrained
            Eigen::VectorXd exact(3 * mesh.n_vertices());
            for (int v = 0; v < mesh.n_vertices(); ++v)
                exact.segment<3>(3 * v) = mesh.vertices.col(v).cwiseProduct(Eigen::Vector3d(1.0, -nu, -nu));
            const double low = mesh.vertices.row(0).minCoeff(), high = mesh.vertices.row(0).maxCoeff();
            const auto ends =
                vertices_where(mesh, [&](const auto& x) { return x[0] < low + 1e-9 || x[0] > high - 1e-9; });
            Control control;
            Deformer deformer(precomputed(make_body(mesh, {1.0, nu}), with_rims(rows)));
            deformer.constrain({{}, ends}, control);
            const Deformer::Answer answer = deformer.answer(at(exact, ends), {.residual = true}, control);
            EXPECT_LT((answer.displacements - exact).cwiseAbs().maxCoeff(), 1e-7) << nu << " " << rows;
            EXPECT_LT(answer.residual.value(), 1e-8) << nu << " " << rows;
            double right = 0.0;
            for (std::size_t i = 0; i < ends.size(); ++i)
                if (mesh.vertices(0, ends[i]) > 0.5 * (low + high))
                    right += answer.reactions.forces(0, static_cast<Eigen::Index>(i));
            EXPECT_NEAR(right, 1.0, 1e-7) << nu << " " << rows;
        }
}

TEST(FinerRims, BalanceForcesAndMoments) {
    const PulledRabbit rabbit;
    const Eigen::VectorXd pulled =
        (Eigen::VectorXd(rabbit.values.size()) << rabbit.values.head(rabbit.values.size() - 2), 0.0, 0.0).finished();
    Control control;
    const Reactions reactions = rabbit.deformer(with_rims(2)).answer(pulled, {}, control).reactions;
    EXPECT_LT(reactions.forces.rowwise().sum().norm(), 1e-9 * reactions.forces.colwise().norm().sum());
    EXPECT_LT(reactions.moments.rowwise().sum().norm(), 1e-9 * reactions.moments.colwise().norm().sum());
}

/// Seen from inside, all edges of an octahedron are re-entrant, and so are nearly all of a bar that is twisted through
/// itself. Those of a box leave two triangles of a face in peace.
TEST(FinerRims, DoNotCutABodyWhereNearlyAllEdgesAreReentrant) {
    for (const int rows : {1, 2, 3}) {
        const SurfaceMesh octahedron = inside_out(make_sphere(1)), box = inside_out(make_box(3));
        EXPECT_FALSE(FinerRims(octahedron, {}, {}, rows, LoneVertices::kept).is_finer) << rows;
        EXPECT_TRUE(FinerRims(box, {}, {}, rows, LoneVertices::kept).is_finer) << rows;
    }
}

/// Work of a motion against the forces of another one is that of the other against the forces of the one.
TEST(FinerRims, AreReciprocal) {
    const PulledRabbit rabbit;
    Control control;
    const Deformer deformer = rabbit.deformer(with_rims(1));
    const Eigen::Index n = 3 * std::ssize(rabbit.body.pull);
    Eigen::VectorXd one = Eigen::VectorXd::Zero(n + 2), other = one;
    for (Eigen::Index i = 0; i < n; ++i) {
        one[i] = std::sin(1.0 + 3.0 * static_cast<double>(i));
        other[i] = std::cos(2.0 + 5.0 * static_cast<double>(i));
    }
    const auto work = [&](const Eigen::VectorXd& moved, const Eigen::VectorXd& by) {
        return moved.head(n).dot(deformer.reactions(by).forces.rightCols(n / 3).reshaped());
    };
    EXPECT_NEAR(work(one, other), work(other, one), 1e-9 * std::abs(work(one, one)));
}

/// Of what moves least, a body that nothing holds is answered on its own surface.
TEST(FinerRims, LeaveABodyThatNothingHoldsAsItIs) {
    const SurfaceMesh mesh = make_box(3);
    Control control;
    Eigen::VectorXd values(6);
    values << 0.1, 0.0, 0.0, -0.1, 0.2, 0.0;
    std::vector<Eigen::VectorXd> answers;
    for (const int rows : {0, 1}) {
        Deformer deformer(precomputed(make_body(mesh), with_rims(rows)));
        deformer.constrain({{}, {0, mesh.n_vertices() - 1}}, control);
        answers.push_back(deformer.displace(values));
    }
    EXPECT_LT(off(answers[1], answers[0]), 1e-9);
    Deformer direct(precomputed(make_body(mesh), with_rims(1, Update::direct)));
    EXPECT_THROW(direct.constrain({{}, {0, 1}}, control), NotHeldError);
}

TEST(FinerRims, TakeTheMemoryThatIsPredictedForThem) {
    const PulledRabbit rabbit;
    const auto model = precomputed(make_body(rabbit.body.surface), with_rims(2));
    const Deformer deformer(model);
    const FinerRims rims(rabbit.body.surface, joined(rabbit.body.fixed, rabbit.body.pull), {}, 2, LoneVertices::kept);
    const auto n = static_cast<std::uint64_t>(3 * rims.surface.mesh.n_vertices());
    EXPECT_GT(deformer.predict_memory(rabbit.set), 8 * 2 * n * n);
    EXPECT_GT(model->facts().memory_bytes, 0u) << "D is kept";
}

/// Two sides of a box, and single triangles all over it.
std::vector<int> many_patches(const SurfaceMesh& box) {
    std::vector<char> marked(static_cast<std::size_t>(box.n_vertices()), 0);
    for (int t = 0; t < box.n_triangles(); t += 17)
        for (const int v : box.triangles.col(t)) marked[static_cast<std::size_t>(v)] = 1;
    std::vector<int> patches;
    for (int v = 0; v < box.n_vertices(); ++v)
        if (marked[static_cast<std::size_t>(v)] || box.vertices(0, v) < kEdge || box.vertices(0, v) > 1.0 - kEdge)
            patches.push_back(v);
    return patches;
}

/// Rows along the rims of many patches make a large surface of a small body.
TEST(FinerRims, OfManyPatchesAreAnsweredByHierarchicalMatrices) {
    const SurfaceMesh mesh = make_box(3);
    const std::vector<int> patches = many_patches(mesh);
    const FinerRims rims(mesh, patches, {}, 3, LoneVertices::kept);
    Method method = with_rims(3);
    method.hierarchical_from = static_cast<int>(rims.surface.mesh.n_vertices());
    ASSERT_FALSE(has_hierarchical_model(mesh, method));

    Eigen::VectorXd stretched(3 * mesh.n_vertices());
    for (int v = 0; v < mesh.n_vertices(); ++v)
        stretched.segment<3>(3 * v) = mesh.vertices.col(v).cwiseProduct(Eigen::Vector3d(1.0, -0.3, -0.3));
    Control control;
    const auto model = precomputed(make_body(mesh, {1.0, 0.3}), method);
    Deformer deformer(model), of_few(model);
    deformer.constrain({{}, patches}, control);
    EXPECT_TRUE(deformer.iterates());
    const Deformer::Answer answer = deformer.answer(at(stretched, patches), {.residual = true}, control);
    EXPECT_LT((answer.displacements - stretched).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_LT(answer.residual.value(), 1e-6);
    of_few.constrain({{}, {0, 1, 2, 3, 4, 5}}, control);
    EXPECT_FALSE(of_few.iterates());
}

TEST(FinerRims, OfManyPatchesAreSaidToTakeTheMemoryOfHierarchicalMatrices) {
    const SurfaceMesh mesh = make_box(9);
    const std::vector<int> patches = many_patches(mesh);
    const Method method = with_rims(3);
    ASSERT_FALSE(has_hierarchical_model(mesh, method));
    const FinerRims rims(mesh, patches, {}, 3, LoneVertices::kept);
    const std::uint64_t dense =
        galerkin_direct_memory(3 * std::int64_t{rims.surface.mesh.n_vertices()}, 3 * rims.n_constrained_triangles);
    EXPECT_LT(Deformer(precomputed(make_body(mesh, {1.0, 0.3}), method)).predict_memory({{}, patches}), dense / 2);
}

/// Rows along re-entrant edges do so, whatever is constrained.
TEST(FinerRims, AlongReentrantEdgesAreKnownBeforeAnythingIsConstrained) {
    const SurfaceMesh box = make_box(12);
    EXPECT_FALSE(has_hierarchical_model(box, with_rims(3)));
    EXPECT_TRUE(has_hierarchical_model(inside_out(box), with_rims(3)));
    const Cost convex = predict_galerkin_bem(make_box(8), with_rims(2)),
               reentrant = predict_galerkin_bem(inside_out(make_box(8)), with_rims(2));
    EXPECT_GT(reentrant.seconds(), 2.0 * convex.seconds());
}

std::vector<int> lower_end(const SurfaceMesh& bar) {
    return vertices_where(bar, [](const auto& x) { return x[0] < kEdge; });
}

/// A needle of 24 vertices took a minute: halves of slivers are slivers as well, and close to each other.
TEST(FinerRims, LeaveSliversAsTheyAre) {
    const SurfaceMesh bar = bar_of_section(0.1, 0.1), needle = bar_of_section(1e-4, 1e-4);
    const FinerRims of_bar(bar, lower_end(bar), {}, 2, LoneVertices::kept);
    const FinerRims of_needle(needle, lower_end(needle), {}, 2, LoneVertices::kept);
    EXPECT_TRUE(of_bar.is_finer);
    EXPECT_TRUE(of_needle.is_finer) << "its end is no sliver";
    EXPECT_LT(of_needle.surface.mesh.n_triangles(), of_bar.surface.mesh.n_triangles());
    const SurfaceMesh ribbon = bar_of_section(1e-4, 1e-7);
    EXPECT_FALSE(FinerRims(ribbon, lower_end(ribbon), {}, 2, LoneVertices::refined).is_finer);
}

/// The same surface again would say that there is no error.
TEST(FinerRims, AreNoSecondAnswerWhereNothingIsFiner) {
    const SurfaceMesh ribbon = bar_of_section(1e-4, 1e-7);
    const std::vector<int> end = lower_end(ribbon);
    const Eigen::VectorXd still = Eigen::VectorXd::Zero(3 * std::ssize(end));
    const Eigen::VectorXd at_rest = Eigen::VectorXd::Zero(ribbon.vertices.size());
    Control control;
    for (const int rows : {0, 1})
        EXPECT_FALSE(galerkin_self_reference(ribbon, with_rims(rows), 0.3, end, {}, still, at_rest, control)) << rows;
}

TEST(FinerRims, KeepLoneVerticesAsTheyAre) {
    const SurfaceMesh mesh = make_box(4);
    const FinerRims kept(mesh, std::vector<int>{5}, {}, 2, LoneVertices::kept),
        refined(mesh, std::vector<int>{5}, {}, 2, LoneVertices::refined);
    EXPECT_EQ(kept.surface.mesh.n_vertices(), mesh.n_vertices());
    EXPECT_GT(refined.surface.mesh.n_vertices(), mesh.n_vertices());
}

}  // namespace
}  // namespace elastolab::test
