// What a Deformer promises of every method, on bodies of some fifty vertices.
#include "deform/deformer.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "base/error.hpp"
#include "elasticity/rigid_motion.hpp"
#include "fem/method.hpp"
#include "mesh/meshes.hpp"
#include "mesh/primitives.hpp"
#include "methods/problem.hpp"

namespace elastolab::test {
namespace {

constexpr double kRounding = 1e-9;  ///< relative; systems of a few hundred unknowns

/// A cube whose left face is fixed and whose right face is a handle.
struct Cube {
    explicit Cube(double size = 1.0, double young_modulus = 1.0, MethodKind kind = kFem)
        : body(make_body(scaled(make_box(3), size), {young_modulus, 0.3})),
          left(vertices_where(*body.surface, [&](const auto& x) { return x[0] < kEdge * size; })),
          right(vertices_where(*body.surface, [&](const auto& x) { return x[0] > (1.0 - kEdge) * size; })),
          deformer(precomputed(body, make_method(kind))) {
        Control control;
        deformer.constrain({left, right}, control);
    }
    /// The right face moved by this.
    Eigen::VectorXd moved(const Eigen::Vector3d& by) const { return by.replicate(std::ssize(right), 1); }

    Body body;
    std::vector<int> left, right;
    Deformer deformer;
};

Eigen::Vector3d sum(const Eigen::Matrix3Xd& forces, Eigen::Index begin, Eigen::Index n) {
    return forces.middleCols(begin, n).rowwise().sum();
}

std::string refusal(const std::function<void()>& call) {
    try {
        call();
    } catch (const SolveError& error) {
        return error.what();
    }
    return "";
}

TEST(Deformer, AnswersLinearlyAndRestsWhereNothingMoves) {
    for (const Method& method : method_variants()) {
        const Cube cube(1.0, 1.0, method.kind);
        const Eigen::VectorXd a = cube.moved({0.1, 0.0, 0.0}), b = cube.moved({0.0, 0.2, -0.1});
        const Eigen::VectorXd u = cube.deformer.displace(a), v = cube.deformer.displace(b);
        EXPECT_LT((cube.deformer.displace(2.0 * a - 3.0 * b) - (2.0 * u - 3.0 * v)).norm(), kRounding * v.norm());
        EXPECT_EQ(cube.deformer.displace(0.0 * a).norm(), 0.0);
        EXPECT_GT(u.norm(), 0.1);
    }
}

TEST(Deformer, DragResponseIsTheAnswerForEveryMotion) {
    const Cube cube;
    const Eigen::VectorXd before = cube.moved({0.1, 0.0, 0.05});
    Eigen::MatrixXd basis(before.size(), 3);
    for (int axis = 0; axis < 3; ++axis) basis.col(axis) = cube.moved(Eigen::Vector3d::Unit(axis));
    const DragResponse response = cube.deformer.drag_response(before, basis);
    const Eigen::Vector3d drag(0.3, -0.2, 0.1);
    Eigen::VectorXd u;
    response.displace(drag, u);
    EXPECT_LT((response.rest - cube.deformer.displace(before)).norm(), kRounding);
    EXPECT_LT((u - cube.deformer.displace(before + basis * drag)).norm(), kRounding);
}

TEST(Deformer, ReactionsBalanceAndGrowWithModulusAndSize) {
    const Eigen::Vector3d by(0.1, 0.02, 0.0);
    const Cube cube;
    const Reactions one = cube.deformer.reactions(cube.moved(by));
    const auto n = static_cast<Eigen::Index>(cube.left.size());
    const Eigen::Vector3d pull = sum(one.forces, n, n);
    EXPECT_GT(pull.x(), 0.05);
    EXPECT_LT((sum(one.forces, 0, n) + pull).norm(), kRounding * pull.norm());
    for (const double size : {1e-6, 1e5}) {
        constexpr double kModulus = 3e7;
        const Cube other(size, kModulus);
        const Reactions all = other.deformer.reactions(other.moved(size * by));
        EXPECT_LT((sum(all.forces, n, n) / (kModulus * size * size) - pull).norm(), kRounding * pull.norm()) << size;
    }
}

/// The previous set stays, and answers as before, whatever happens to a new one.
TEST(Deformer, KeepsItsSetWhereANewOneFails) {
    Cube cube;
    const Eigen::VectorXd values = cube.moved({0.1, 0.0, 0.0}), before = cube.deformer.displace(values);
    Control cancelled;
    cancelled.cancel();
    EXPECT_THROW(cube.deformer.constrain({{}, {0, 1, 2, 3}}, cancelled), Cancelled);
    EXPECT_EQ(cube.deformer.set().fixed, cube.left);
    EXPECT_EQ(cube.deformer.set().handles, cube.right);
    EXPECT_EQ(cube.deformer.displace(values), before);
}

TEST(Deformer, LeavesASolidWithoutConstrainedVerticesAtRest) {
    const SurfaceMesh pair = joined(make_box(2), moved(make_box(2), {3, 0, 0}));
    const std::vector<int> left = vertices_where(pair, [](const auto& x) { return x[0] < kEdge; });
    const std::vector<int> right = vertices_where(pair, [](const auto& x) { return std::abs(x[0] - 1.0) < kEdge; });
    Deformer deformer(precomputed(make_body(pair), make_method(kFem)));
    Control control;
    deformer.constrain({left, right}, control);
    const Eigen::VectorXd u = deformer.displace(Eigen::Vector3d(0.1, 0, 0).replicate(std::ssize(right), 1));
    for (int v = 0; v < pair.n_vertices(); ++v)
        EXPECT_EQ(u.segment<3>(3 * v).norm() > 0.0, pair.vertices(0, v) > kEdge && pair.vertices(0, v) < 2.0) << v;
}

TEST(Deformer, SaysThatABodyIsNotHeld) {
    Cube cube;
    Control control;
    cube.deformer.constrain({{}, {cube.right.front()}}, control);
    EXPECT_FALSE(cube.deformer.quality().held);
    EXPECT_TRUE(cube.deformer.quality().free_to_move);
    const Eigen::VectorXd u = cube.deformer.displace(Eigen::Vector3d(0.1, 0.2, 0.3));
    EXPECT_LT((u.segment<3>(3 * cube.right.front()) - Eigen::Vector3d(0.1, 0.2, 0.3)).norm(), 1e-12);
    // The smallest motion: rigid, and smaller than the translation, since a turn moves the vertex as well.
    const Eigen::MatrixXd modes = rigid_modes(cube.body.surface->vertices);
    EXPECT_LT((u - modes * (modes.transpose() * u)).norm(), 1e-6 * u.norm());
    EXPECT_LT(u.norm(), 0.9 * Eigen::Vector3d(0.1, 0.2, 0.3).norm() * std::sqrt(cube.body.surface->n_vertices()));
}

/// Forces that leave the range of numbers are an error, and no zero or infinity.
TEST(Deformer, RefusesForcesBeyondDoublePrecision) {
    const auto answered = [](double modulus, double by) {
        const Cube cube(1.0, modulus);
        return refusal([&] { cube.deformer.reactions(cube.moved({by, 0.0, 0.0})); });
    };
    EXPECT_THAT(answered(1e-300, 1e-12), testing::HasSubstr("below double precision"));
    EXPECT_THAT(answered(1e300, 1e12), testing::HasSubstr("beyond double precision"));
    EXPECT_EQ(answered(1e-300, 0.1), "");
    EXPECT_EQ(answered(1e300, 0.1), "");
    EXPECT_EQ(answered(1e-300, 0.0), "");
}

TEST(Deformer, ResidualsAreRounding) {
    for (const Method& method : method_variants()) {
        const Cube cube(1.0, 1.0, method.kind);
        Control control;
        EXPECT_LT(cube.deformer.residual(cube.moved({0.1, 0.05, 0.0}), control), kRounding) << describe(method);
    }
}

}  // namespace
}  // namespace elastolab::test
