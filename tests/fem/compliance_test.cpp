#include "fem/compliance.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <utility>

#include "base/blas.hpp"
#include "base/lapack.hpp"
#include "deform/holds.hpp"
#include "elasticity/rigid_motion.hpp"
#include "fem/fem_body.hpp"

namespace elastolab {
namespace {

using test::FemBody;
using test::relative_error;

// Dense reference and sparse solve each lose about condition * eps, the condition being 1e3 to 1e4 here.
constexpr double kRounding = 1e-10;

std::vector<int> all_surface(const FemBody& body) {
    std::vector<int> vertices(static_cast<std::size_t>(body.n_surface()));
    std::iota(vertices.begin(), vertices.end(), 0);
    return vertices;
}

/// The block D of the bordered inverse of the condensed stiffness, dense.
Eigen::MatrixXd bordered_inverse(const FemBody& body) {
    const Eigen::MatrixXd S = test::dense_condensed(body);
    const Eigen::MatrixXd R = rigid_modes(body.mesh.vertices.leftCols(body.n_surface()));
    Eigen::MatrixXd bordered = Eigen::MatrixXd::Zero(S.rows() + 6, S.cols() + 6);
    bordered << S, R, R.transpose(), Eigen::MatrixXd::Zero(6, 6);
    return LuFactorization(std::move(bordered), "bordered stiffness").inverse().topLeftCorner(S.rows(), S.cols());
}

TEST(SurfaceCompliance, OfAFreeBodyIsTheBorderedInverse) {
    const FemBody body({4, 4, 3});
    Control control;
    const SurfaceCompliance compliance(body.K, body.analysis, body.mesh.vertices, body.n_surface(), {}, control);
    const Eigen::MatrixXd D = compliance.columns(all_surface(body), control);
    const Eigen::MatrixXd expected = bordered_inverse(body);
    EXPECT_LT(relative_error(D, expected), kRounding);
    EXPECT_LT(relative_error(D, D.transpose()), kRounding);
    EXPECT_LT((compliance.rigid().transpose() * D).cwiseAbs().maxCoeff(), kRounding * D.cwiseAbs().maxCoeff());
}

TEST(SurfaceCompliance, OfAFreeBodyIsTheMoorePenroseInverseOfTheCondensedStiffness) {
    const FemBody body({3, 3, 3});
    Control control;
    const SurfaceCompliance compliance(body.K, body.analysis, body.mesh.vertices, body.n_surface(), {}, control);
    const Eigen::MatrixXd S = test::dense_condensed(body);
    const Eigen::MatrixXd pseudo_inverse =
        solve_minimum_norm(S, Eigen::MatrixXd::Identity(S.rows(), S.cols()), 1e-10).X;
    EXPECT_LT(relative_error(compliance.columns(all_surface(body), control), pseudo_inverse), kRounding);
}

TEST(SurfaceCompliance, DoesNotDependOnWhereTheBodyIsSupported) {
    const FemBody body({5, 4, 3});
    Control control;
    const std::vector<int> vertices = {0, 17, body.n_surface() - 1};
    const SurfaceCompliance chosen(body.K, body.analysis, body.mesh.vertices, body.n_surface(), {}, control);
    const Eigen::MatrixXd expected = chosen.columns(vertices, control);
    for (const StaticSupport& support :
         {StaticSupport{3, 40, 60}, StaticSupport{10, 11, 30}, StaticSupport{70, 20, 5}}) {
        const SurfaceCompliance other = SurfaceCompliance::supported_at(support, body.K, body.analysis,
                                                                        body.mesh.vertices, body.n_surface(), control);
        EXPECT_LT(relative_error(other.columns(vertices, control), expected), kRounding);
    }
}

TEST(SurfaceCompliance, WithABaseIsTheInverseOfTheFreeBlock) {
    const FemBody body({4, 4, 3});
    Control control;
    const std::vector<int> fixed = body.face(0, 0.0);
    const SurfaceCompliance compliance(body.K, body.analysis, body.mesh.vertices, body.n_surface(), fixed, control);
    Eigen::MatrixXd K_ff(body.K);
    for (int v : fixed) {
        K_ff.middleRows<3>(3 * v).setZero();
        K_ff.middleCols<3>(3 * v).setZero();
        K_ff.block<3, 3>(3 * v, 3 * v).setIdentity();
    }
    Eigen::MatrixXd expected = spd_inverse(K_ff, "free part").leftCols(3 * body.n_surface());
    expected.conservativeResize(3 * body.n_surface(), Eigen::NoChange);
    for (int v : fixed) expected.block<3, 3>(3 * v, 3 * v).setZero();
    const Eigen::MatrixXd D = compliance.columns(all_surface(body), control);
    EXPECT_LT(relative_error(D, expected), kRounding);
    for (int v : fixed) EXPECT_EQ(D.middleRows<3>(3 * v).norm() + D.middleCols<3>(3 * v).norm(), 0.0);
    EXPECT_EQ(compliance.rigid().cols(), 0);
}

TEST(SurfaceCompliance, StaysAccurateNearIncompressibility) {
    const FemBody body({4, 3, 3}, {1.0, 1.2, 0.8}, 0.4999);
    Control control;
    const SurfaceCompliance compliance(body.K, body.analysis, body.mesh.vertices, body.n_surface(), {}, control);
    EXPECT_LT(relative_error(compliance.columns(all_surface(body), control), bordered_inverse(body)), 1e-9);
}

TEST(SurfaceCompliance, AppliesToLoadsAsItsColumnsDo) {
    const FemBody body({4, 4, 3});
    Control control;
    const SurfaceCompliance compliance(body.K, body.analysis, body.mesh.vertices, body.n_surface(), {}, control);
    Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(3 * body.n_surface(), 2);
    loads(7, 0) = 2.0;
    loads(12, 1) = -1.0;
    loads(20, 1) = 0.5;
    const Eigen::MatrixXd D = compliance.columns(all_surface(body), control);
    EXPECT_LT(relative_error(compliance.apply(loads, control), D * loads), 1e-12);
}

TEST(SurfaceCompliance, ItsBlocksAreThoseOfItsColumns) {
    const FemBody body({6, 4, 4});
    Control control;
    const std::vector<int> scattered = {70, 3, 41, body.n_surface() - 1, 12};
    for (const std::vector<int>& fixed : {std::vector<int>{}, body.face(0, 0.0)}) {
        std::vector<int> vertices = body.face(0, 1.0);
        for (const int v : scattered)
            if (body.mesh.vertices(0, v) > 0.0 && body.mesh.vertices(0, v) < 1.0) vertices.push_back(v);
        const SurfaceCompliance compliance(body.K, body.analysis, body.mesh.vertices, body.n_surface(), fixed, control);
        const Eigen::MatrixXd columns = compliance.columns(vertices, control);
        Eigen::MatrixXd expected(columns.cols(), columns.cols());
        for (std::size_t i = 0; i < vertices.size(); ++i)
            expected.middleRows<3>(3 * static_cast<Eigen::Index>(i)) = columns.middleRows<3>(3 * vertices[i]);
        const Eigen::MatrixXd block = compliance.block(vertices, control);
        EXPECT_LT(relative_error(block, expected), kRounding);
        EXPECT_EQ(block, Eigen::MatrixXd(block.transpose())) << "not exactly symmetric";
    }
}

TEST(SurfaceCompliance, DoesNotDependOnTheNumberOfThreads) {
    const FemBody body({6, 6, 5});
    Control control;
    const SurfaceCompliance compliance(body.K, body.analysis, body.mesh.vertices, body.n_surface(), {}, control);
    const int threads = thread_count();
    set_thread_count(1);
    const Eigen::MatrixXd one = compliance.columns(all_surface(body), control);
    set_thread_count(2);
    const Eigen::MatrixXd two = compliance.columns(all_surface(body), control);
    set_thread_count(threads);
    EXPECT_LT(relative_error(one, two), 1e-14);
}

TEST(Holds, AsksForThreeVerticesOffALine) {
    const TetMesh mesh = test::make_tet_box({2, 2, 2}, {1.0, 1.0, 1.0});
    const std::vector<int> edge = test::vertices_where(mesh.vertices, mesh.n_surface_vertices,
                                                       [](const auto& p) { return p[0] == 0.0 && p[1] == 0.0; });
    ASSERT_EQ(edge.size(), 3u);
    EXPECT_FALSE(holds(mesh.vertices, edge));
    EXPECT_FALSE(holds(mesh.vertices, std::span(edge).first(2)));
    const std::vector<int> face =
        test::vertices_where(mesh.vertices, mesh.n_surface_vertices, [](const auto& p) { return p[0] == 0.0; });
    EXPECT_TRUE(holds(mesh.vertices, face));
}

}  // namespace
}  // namespace elastolab
