#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "bem/collocation/constant_constraints.hpp"
#include "bem/collocation/method.hpp"
#include "deform/node_solver.hpp"
#include "elasticity/rigid_motion.hpp"
#include "fem/method.hpp"
#include "findings/cost.hpp"
#include "findings/solution.hpp"
#include "findings/words.hpp"
#include "mesh/meshes.hpp"
#include "mesh/primitives.hpp"
#include "methods/precompute.hpp"
#include "methods/problem.hpp"
#include "methods/registry.hpp"

namespace elastolab::test {
namespace {

TEST(Constraints, ThatHoldTooLittleGiveTheSmallestMotionAndSaySo) {
    const SurfaceMesh mesh = make_box(4);
    // A corner, the centre of a face (where the axes of rotations pass) and a vertex beside it.
    const auto held_at = vertices_where(
        mesh, [](const auto& x) { return x.norm() < 1e-9 || (x - Eigen::Vector3d(0.5, 0.5, 0.0)).norm() < 0.26; });
    ASSERT_GE(held_at.size(), 4u);
    for (const Method& method : method_variants()) {
        Control control;
        const auto model = precomputed(make_body(mesh), method);
        for (const int vertex : held_at) {
            Deformer deformer(model);
            deformer.constrain({{}, {vertex}}, control);
            const Eigen::VectorXd u = deformer.displace(Eigen::Vector3d(0.1, 0.2, 0.3));
            if (method.kind != kConstantBem) {  // whose lone vertex holds the triangles around it
                EXPECT_FALSE(deformer.quality().held) << describe(method);
                EXPECT_FALSE(findings_of_set(deformer).empty()) << describe(method);
            }
            // One vertex moved, nothing strained: a rigid motion, and no larger than the translation.
            const Eigen::MatrixXd modes = rigid_modes(mesh.vertices);
            const double strained = (u - modes * (modes.transpose() * u)).norm();
            EXPECT_LT(strained, (method.kind == kConstantBem ? 0.3 : 1e-8) * u.norm()) << describe(method);
            const double translation = Eigen::Vector3d(0.1, 0.2, 0.3).norm() * std::sqrt(mesh.n_vertices());
            EXPECT_LT(u.norm(), 1.0001 * translation) << describe(method) << ", vertex " << vertex;
        }
    }
}

TEST(Constraints, OfABaseAloneNeedNoForces) {
    const SurfaceMesh mesh = make_box(3);
    const auto fixed = vertices_where(mesh, [](const auto& x) { return x[0] < 1e-9; });
    for (const Update update : {Update::reduced, Update::direct})
        for (const Method& method : method_variants(Mode::on_demand, update)) {
            Control control;
            Deformer deformer(precomputed(make_body(mesh), method));
            deformer.constrain({fixed, {}}, control);
            EXPECT_EQ(deformer.displace(Eigen::VectorXd(0)).norm(), 0.0) << describe(method);
            EXPECT_EQ(deformer.reactions(Eigen::VectorXd(0)).forces.norm(), 0.0) << describe(method);
        }
}

TEST(Constraints, ThatHoldABodyAreNotBlamedForASingularSystem) {
    Control control;
    const SurfaceMesh mesh = make_hollow_sphere(4);
    const auto all = vertices_where(mesh, [](const auto&) { return true; });
    const Body body = make_body(mesh, {1.0, 0.5});
    Deformer reduced(precomputed(body, make_method(kConstantBem)));
    reduced.constrain({{}, all}, control);
    EXPECT_FALSE(reduced.quality().held);
    EXPECT_THAT(words(findings_of_set(reduced)), ::testing::Contains(::testing::HasSubstr("hold the body, but")));
    Deformer direct(
        precomputed(body, make_method(kConstantBem, Tractions::discontinuous, Mode::on_demand, Update::direct)));
    EXPECT_THAT(
        [&] {
            direct.constrain({{}, all}, control);
        },
        ::testing::ThrowsMessage<NotHeldError>(::testing::HasSubstr("hold the body, but")));
}

TEST(Constraints, OnALineLeaveARotationFree) {
    const SurfaceMesh mesh = make_box(3);
    const auto edge = vertices_where(mesh, [](const auto& x) { return x[1] < 1e-9 && x[2] < 1e-9; });
    for (const Method& method : method_variants()) {
        if (method.kind == kConstantBem) continue;
        Control control;
        Deformer deformer(precomputed(make_body(mesh), method));
        deformer.constrain({{}, edge}, control);
        EXPECT_FALSE(deformer.quality().held) << describe(method);
        const Eigen::VectorXd values = Eigen::Vector3d(0.0, 0.0, 0.1).replicate(std::ssize(edge), 1);
        EXPECT_TRUE(deformer.displace(values).allFinite()) << describe(method);
        EXPECT_THROW(displaced(precomputed(make_body(mesh),
                                           make_method(method.kind, method.tractions, Mode::on_demand, Update::direct)),
                               {{}, edge}, values),
                     SolveError)
            << describe(method);
    }
}

TEST(Constraints, OfOneSolidDoNotMoveAnother) {
    const SurfaceMesh one = make_box(3), two = joined(one, moved(make_sphere(2), {5.0, 0.0, 0.0}));
    const auto fixed = vertices_where(one, [](const auto& x) { return x[0] < 1e-9; });
    const auto pull = vertices_where(one, [](const auto& x) { return x[0] > 1.0 - 1e-9; });
    const Eigen::VectorXd values = Eigen::Vector3d(0.1, 0.05, 0.0).replicate(std::ssize(pull), 1);
    for (const Method& method : method_variants()) {
        const Eigen::VectorXd alone = displaced(precomputed(make_body(one), method), {fixed, pull}, values);
        const Eigen::VectorXd both = displaced(precomputed(make_body(two), method), {fixed, pull}, values);
        EXPECT_LT((both.head(alone.size()) - alone).norm(), 1e-12 * alone.norm()) << describe(method);
        EXPECT_EQ(both.tail(both.size() - alone.size()).norm(), 0.0) << describe(method);
    }
}

TEST(Constraints, KeepThePreviousSetWhenANewOneFails) {
    const SurfaceMesh mesh = make_box(3);
    const Method method = make_method(kFem, Tractions::discontinuous, Mode::on_demand, Update::direct);
    Control control;
    Deformer deformer(precomputed(make_body(mesh), method));
    const auto fixed = vertices_where(mesh, [](const auto& x) { return x[0] < 1e-9; });
    deformer.constrain({fixed, {mesh.n_vertices() - 1}}, control);
    const Eigen::VectorXd before = deformer.displace(Eigen::Vector3d(0.1, 0.0, 0.0));
    EXPECT_THROW(deformer.constrain({{}, {0}}, control), SolveError);
    EXPECT_EQ(deformer.displace(Eigen::Vector3d(0.1, 0.0, 0.0)), before);
}

TEST(ConstantBem, ConstrainsATriangleWhenAllItsVerticesAre) {
    const SurfaceMesh mesh = make_box(2);
    const VertexTriangles triangles_of_vertex(mesh);
    const std::vector<int> corners(mesh.triangles.col(4).begin(), mesh.triangles.col(4).end());
    const ConstrainedNodes whole = constrain_triangles(mesh, triangles_of_vertex, corners);
    EXPECT_EQ(whole.nodes, std::vector<int>{4});
    const Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(9, 1.0, 9.0);
    EXPECT_LT((whole.prescribe * values - Eigen::Vector3d(4.0, 5.0, 6.0)).norm(), 1e-14);

    const ConstrainedNodes lone = constrain_triangles(mesh, triangles_of_vertex, std::vector<int>{corners[0]});
    EXPECT_EQ(lone.nodes.size(), triangles_of_vertex[corners[0]].size());
}

TEST(ConstantBem, MovesALoneHandleVertexExactlyWithItsHandle) {
    const SurfaceMesh mesh = make_box(4);
    const auto fixed = vertices_where(mesh, [](const auto& x) { return x[0] < 1e-9; });
    const auto lone =
        vertices_where(mesh, [](const auto& x) { return (x - Eigen::Vector3d(1.0, 0.5, 0.5)).norm() < 1e-9; });
    ASSERT_EQ(lone.size(), 1u);
    const Eigen::Vector3d shift(0.1, 0.2, -0.1);
    const Eigen::VectorXd u = displaced(precomputed(make_body(mesh), make_method(kConstantBem)), {fixed, lone}, shift);
    EXPECT_LT((u.segment<3>(3 * lone[0]) - shift).norm(), 1e-14);
}

TEST(Memory, ThatIsNotThereIsNotBegunWith) {
    const SurfaceMesh huge = make_box(200);  // 240 002 vertices: a dense matrix of 4 TB
    Control control;
    const Method method = make_method(kLinearBem, Tractions::restricted, Mode::full);
    try {
        precompute(make_body(huge), method, control);
        FAIL() << "was begun";
    } catch (const SolveError& error) {
        EXPECT_NE(std::string(error.what()).find("GB"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("on-demand"), std::string::npos) << error.what();
    }
}

TEST(Methods, HaveNamesThatAreReadBack) {
    for (const Method& method : method_variants()) {
        EXPECT_EQ(parse_method_kind(name(method.kind)), method.kind);
        EXPECT_EQ(parse_tractions(name(method.tractions)), method.tractions);
    }
    EXPECT_FALSE(parse_mode("fuller").has_value());
    EXPECT_EQ(parse_mode("full-volume"), Mode::full_volume);
    EXPECT_EQ(parse_update("eqn9"), Update::eqn9);
}

/// Young's modulus times displacement may overflow where each of them does not.
TEST(Reactions, ThatAreBeyondDoublePrecisionAreAnError) {
    const SurfaceMesh mesh = make_box(2);
    const auto fixed = vertices_where(mesh, [](const auto& x) { return x[0] < 1e-9; });
    for (const MethodKind kind : elastolab::all_methods()) {
        if (!kind->linear) continue;  // such a motion has no equilibrium
        Control control;
        Deformer deformer(precomputed(make_body(mesh, {1e300, 0.3}), {.kind = kind}));
        deformer.constrain({fixed, {mesh.n_vertices() - 1}}, control);
        EXPECT_TRUE(deformer.displace(Eigen::Vector3d(1e10, 0.0, 0.0)).allFinite()) << kind->name;
        EXPECT_THROW(deformer.reactions(Eigen::Vector3d(1e10, 0.0, 0.0)), SolveError) << kind->name;
    }
}

}  // namespace
}  // namespace elastolab::test
