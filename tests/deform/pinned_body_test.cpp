#include "deform/pinned_body.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numeric>

#include "mesh/primitives.hpp"

namespace elastolab::test {
namespace {

Positions turned(const Positions& x, const Eigen::Vector3d& about, const Eigen::Vector3d& omega) {
    Positions u(3, x.cols());
    for (Eigen::Index v = 0; v < x.cols(); ++v) u.col(v) = omega.cross(Eigen::Vector3d(x.col(v) - about));
    return u;
}

ReferenceAnswer answer_of(const Eigen::VectorXd& u, std::size_t n) {
    const auto columns = static_cast<Eigen::Index>(n);
    return {u, {Eigen::Matrix3Xd::Ones(3, columns), Eigen::Matrix3Xd::Ones(3, columns)}};
}

TEST(PinnedBody, StaysAsItIsWhereItIsHeld) {
    const SurfaceMesh mesh = make_box(2);
    std::vector<int> face;
    for (int v = 0; v < mesh.n_vertices(); ++v)
        if (mesh.vertices(0, v) < 1e-9) face.push_back(v);
    const Eigen::VectorXd first = Eigen::VectorXd::Random(mesh.vertices.size()),
                          values = Eigen::VectorXd::LinSpaced(3 * std::ssize(face) + 1, 0.0, 1.0);
    const PinnedBody body(mesh.vertices, face, values, first);
    EXPECT_FALSE(body.is_pinned());
    EXPECT_EQ(body.vertices(), face);
    EXPECT_EQ(body.values(), values);
    const Eigen::VectorXd second = Eigen::VectorXd::Random(first.size());
    EXPECT_EQ(body.released(answer_of(second, face.size())).displacements, second);
}

TEST(PinnedBody, IsHeldByThreeVerticesWhereTheFirstAnswerPutsThem) {
    const SurfaceMesh mesh = make_box(2);
    const Eigen::VectorXd first = Eigen::VectorXd::Random(mesh.vertices.size());
    const Eigen::VectorXd values = Eigen::Vector4d(0.1, 0.2, 0.3, 7.0);  // of a vertex, and the factor of a load
    const std::vector<int> one = {4};
    const PinnedBody body(mesh.vertices, one, values, first);
    ASSERT_TRUE(body.is_pinned());
    ASSERT_EQ(body.vertices().size(), 4U);
    ASSERT_EQ(body.values().size(), 13);
    EXPECT_EQ(body.values().head(3), values.head(3));
    EXPECT_EQ(body.values()[12], 7.0);
    for (int i = 1; i < 4; ++i) {
        const int v = body.vertices()[static_cast<std::size_t>(i)];
        EXPECT_NE(v, 4);
        EXPECT_EQ(body.values().segment<3>(3 * i), first.segment<3>(3 * v));
    }
}

TEST(PinnedBody, OfFourVerticesTakesWhatIsLeft) {
    Positions tetrahedron = Positions::Zero(3, 4);
    tetrahedron.rightCols<3>().setIdentity();
    const std::vector<int> edge = {0, 1};
    const PinnedBody body(tetrahedron, edge, Eigen::VectorXd::Zero(6), Eigen::VectorXd::Ones(12));
    EXPECT_TRUE(body.is_held());
    EXPECT_EQ(body.vertices().size(), 4U);
    EXPECT_EQ(body.values().tail(6), Eigen::VectorXd::Ones(6));
    EXPECT_EQ(body.released(answer_of(Eigen::VectorXd::Ones(12), 4)).reactions.forces.cols(), 2);
}

TEST(PinnedBody, OfANeedleIsNotHeldByPinsEither) {
    Positions needle = make_box(2).vertices;
    needle.bottomRows<2>() *= 1e-8;
    const Eigen::VectorXd first = Eigen::VectorXd::Zero(needle.size());
    const PinnedBody free(needle, {}, Eigen::VectorXd(), first);
    EXPECT_FALSE(free.is_held());
    EXPECT_FALSE(free.is_pinned());
    std::vector<int> all(static_cast<std::size_t>(needle.cols()));
    std::iota(all.begin(), all.end(), 0);
    const PinnedBody constrained(needle, all, first, first);
    EXPECT_FALSE(constrained.is_held());
    EXPECT_EQ(constrained.vertices(), all);
}

/// Both answers differ by a stretch: a rigid motion between them is none of their errors.
TEST(PinnedBody, MovesTheSecondAnswerToTheFirst) {
    const SurfaceMesh mesh = make_box(2);
    const Positions& x = mesh.vertices;
    const Positions first = turned(x, {0.5, 0.5, 0.5}, {0.1, 0.2, -0.3});
    const Positions stretch = 1e-3 * (x.colwise() - Eigen::Vector3d(0.5, 0.5, 0.5));
    const Positions second = first + stretch + turned(x, {3.0, -1.0, 2.0}, {-0.4, 0.5, 0.6});
    const PinnedBody body(x, {}, Eigen::VectorXd(), first.reshaped());
    const ReferenceAnswer released = body.released(answer_of(second.reshaped(), 3));
    EXPECT_LT((released.displacements - first.reshaped() - stretch.reshaped()).norm(), 1e-12);
    EXPECT_EQ(released.reactions.forces.cols(), 0);
}

/// About a vertex that stays in its place the body can only turn.
TEST(PinnedBody, MovesItOnlyAsTheConstraintsLet) {
    const SurfaceMesh mesh = make_box(2);
    const Positions& x = mesh.vertices;
    const Eigen::Vector3d corner = x.col(0);
    const Eigen::VectorXd first = Eigen::VectorXd::Zero(x.size());
    const Positions turn = turned(x, corner, {-0.4, 0.5, 0.6});
    const PinnedBody body(x, std::vector<int>{0}, Eigen::VectorXd::Zero(3), first);
    EXPECT_LT(body.released(answer_of(turn.reshaped(), 4)).displacements.norm(), 1e-12);
    const Positions shift = Eigen::Vector3d(0.1, 0.0, 0.0).replicate(1, x.cols());
    EXPECT_GT(body.released(answer_of(shift.reshaped(), 4)).displacements.norm(), 0.3 * shift.norm());
}

}  // namespace
}  // namespace elastolab::test
