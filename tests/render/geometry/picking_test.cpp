#include "render/geometry/picking.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <Eigen/Geometry>
#include <random>
#include <set>
#include <vector>

#include "mesh/input/merge.hpp"
#include "mesh/primitives.hpp"
#include "render/geometry/visibility.hpp"
#include "render/viewpoint.hpp"

namespace elastolab {
namespace {

using test::camera_at;

constexpr Viewport kView{0.0, 0.0, 1000.0, 800.0};

std::optional<PickHit> pick_on(const SurfaceMesh& mesh, const Camera& camera, const Eigen::Vector2d& cursor,
                               double snap = 12.0) {
    return pick(camera, kView, cursor, mesh.vertices, mesh.triangles, snap);
}

TEST(Picking, FindsThePointUnderTheCursorOnTheNearSide) {
    for (const double radius : {1e-9, 1.0, 1e9}) {
        const SurfaceMesh mesh = make_sphere(10, radius);
        const Camera camera = camera_at({Eigen::Vector3d::Zero(), radius}, kView);
        std::mt19937 engine(1);
        std::uniform_real_distribution<> offset(-200, 200);
        for (int i = 0; i < 100; ++i) {
            const Eigen::Vector2d cursor(500 + offset(engine), 400 + offset(engine));
            const auto hit = pick_on(mesh, camera, cursor);
            ASSERT_TRUE(hit && hit->triangle >= 0);
            EXPECT_LT((camera.project(hit->point, kView).pixel - cursor).norm(), 1e-6);
            EXPECT_GT(hit->point.dot(camera.backward()), 0.0);
            EXPECT_NEAR(hit->barycentric.sum(), 1.0, 1e-12);
            EXPECT_GE(hit->barycentric.minCoeff(), -1e-9);
        }
    }
}

TEST(Picking, FindsAVertexThatIsUnderTheCursorExactly) {
    const SurfaceMesh mesh = make_sphere(8);
    const Camera camera = camera_at({}, kView);
    for (int vertex = 0; vertex < mesh.n_vertices(); ++vertex) {
        if (mesh.vertices.col(vertex).dot(camera.backward()) < 0.4) continue;
        const auto hit = pick_on(mesh, camera, camera.project(mesh.vertices.col(vertex), kView).pixel);
        ASSERT_TRUE(hit);
        EXPECT_EQ(hit->vertex, vertex);
        EXPECT_GE(hit->triangle, 0);
        EXPECT_LT(hit->vertex_distance, 1e-6);
    }
}

TEST(Picking, MeetsTrianglesFromBehindToo) {
    SurfaceMesh mesh = make_sphere(4);
    mesh.triangles.row(0).swap(mesh.triangles.row(1));
    const auto hit = pick_on(mesh, camera_at({}, kView), kView.center());
    ASSERT_TRUE(hit && hit->triangle >= 0);
    EXPECT_GT(hit->point.dot(camera_at({}, kView).backward()), 0.5);
}

TEST(Picking, SnapsToAVisibleVertexBesideTheBody) {
    const SurfaceMesh mesh = make_box(1);
    const Camera camera = camera_at({Eigen::Vector3d::Constant(0.5), 0.9}, kView);
    for (int vertex = 0; vertex < 8; ++vertex) {
        const Eigen::Vector2d pixel = camera.project(mesh.vertices.col(vertex), kView).pixel;
        const Eigen::Vector2d outward = (pixel - kView.center()).normalized();
        if ((pixel - kView.center()).norm() < 150) continue;  // those in the middle
        const auto near = pick_on(mesh, camera, pixel + 8.0 * outward),
                   far = pick_on(mesh, camera, pixel + 20.0 * outward);
        ASSERT_TRUE(near);
        EXPECT_EQ(near->triangle, -1);
        EXPECT_EQ(near->vertex, vertex);
        EXPECT_NEAR(near->vertex_distance, 8.0, 1e-6);
        EXPECT_FALSE(far);
    }
}

TEST(Picking, DoesNotSnapToAHiddenVertex) {
    // A triangle of the front covers the one of the back except for what is right of the cursor's side.
    Eigen::Matrix3Xd positions(3, 6);
    positions << -1, 1, 0, -0.1, 0.1, 0, -1, -1, 1, 0, 0, 0.1, 0, 0, 0, -1, -1, -1;
    Eigen::Matrix3Xi triangles(3, 2);
    triangles << 0, 3, 1, 4, 2, 5;
    Camera camera;
    camera.look_from({0, 0, 1}, {0, 1, 0});
    for (int vertex = 3; vertex < 6; ++vertex) EXPECT_FALSE(is_visible(camera.eye(), vertex, positions, triangles));
    camera.look_from({0, 0, -1}, {0, 1, 0});
    for (int vertex = 0; vertex < 6; ++vertex) EXPECT_TRUE(is_visible(camera.eye(), vertex, positions, triangles));
}

TEST(Picking, SelectsTheVisibleVerticesOfARectangle) {
    const SurfaceMesh mesh = make_sphere(12);
    const Camera camera = camera_at({}, kView);
    const auto all =
        vertices_in_rectangle(camera, kView, {0, 0}, {1000, 800}, mesh.vertices, mesh.triangles, Reach::through);
    EXPECT_EQ(static_cast<int>(all.size()), mesh.n_vertices());
    const auto visible =
        vertices_in_rectangle(camera, kView, {1000, 0}, {0, 800}, mesh.vertices, mesh.triangles, Reach::visible);
    const double horizon = 1.0 / camera.pose().distance;
    for (int vertex = 0; vertex < mesh.n_vertices(); ++vertex) {
        const double height = mesh.vertices.col(vertex).dot(camera.backward());
        const bool found = std::binary_search(visible.begin(), visible.end(), vertex);
        if (std::abs(height - horizon) < 0.1) continue;
        EXPECT_EQ(found, height > horizon) << height;
    }
}

TEST(Picking, SortsIntoCellsWithoutChangingWhatIsVisible) {
    const SurfaceMesh mesh = make_torus(8);
    const Camera camera = camera_at({Eigen::Vector3d::Zero(), 1.35}, kView);
    std::vector<int> all, expected;
    for (int vertex = 0; vertex < mesh.n_vertices(); ++vertex) {
        all.push_back(vertex);
        if (is_visible(camera.eye(), vertex, mesh.vertices, mesh.triangles)) expected.push_back(vertex);
    }
    EXPECT_EQ(visible_of(all, camera, kView, mesh.vertices, mesh.triangles), expected);
    EXPECT_GT(expected.size(), all.size() / 4);
    EXPECT_LT(expected.size(), all.size() * 3 / 4);
}

TEST(Picking, VerticesOfNoTriangleAreNotThere) {
    const SurfaceMesh mesh = make_sphere(6);
    const Camera camera = camera_at({}, kView);
    Positions more(3, mesh.n_vertices() + 1);
    more << mesh.vertices, Eigen::Vector3d(0.0, 0.0, 1.5);
    const Eigen::Vector2d there = camera.project(more.col(mesh.n_vertices()), kView).pixel;
    const auto hit = pick(camera, kView, there, more, mesh.triangles, 2000.0);
    ASSERT_TRUE(hit);
    EXPECT_LT(hit->vertex, mesh.n_vertices());
    EXPECT_TRUE(vertices_in_brush(camera, kView, there, there, 1.0, more, mesh.triangles, Reach::visible).empty());
}

TEST(Picking, PaintsWithARoundBrush) {
    const SurfaceMesh mesh = make_sphere(12);
    const Camera camera = camera_at({}, kView);
    const Eigen::Vector2d cursor(540, 380);
    const auto paint = [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
        return vertices_in_brush(camera, kView, from, to, 90.0, mesh.vertices, mesh.triangles, Reach::visible);
    };
    const auto painted = paint(cursor, cursor);
    std::vector<int> expected;
    for (int vertex = 0; vertex < mesh.n_vertices(); ++vertex) {
        const bool near = (camera.project(mesh.vertices.col(vertex), kView).pixel - cursor).norm() <= 90.0;
        if (near && mesh.vertices.col(vertex).dot(camera.backward()) > 0.0) expected.push_back(vertex);
    }
    EXPECT_EQ(painted, expected);
    EXPECT_GT(painted.size(), 3u);
    // A stroke has all that is painted in many small steps.
    const Eigen::Vector2d way(-300, 40);
    std::set<int> in_steps;
    for (int i = 0; i <= 1000; ++i)
        for (const int v : paint(cursor + 0.001 * i * way, cursor + 0.001 * i * way)) in_steps.insert(v);
    const auto stroke = paint(cursor, cursor + way);
    EXPECT_EQ(stroke, std::vector<int>(in_steps.begin(), in_steps.end()));
    EXPECT_GT(stroke.size(), 2 * painted.size());
}

TEST(Picking, CopesWithTrianglesThatReachBehindTheEye) {
    Eigen::Matrix3Xd positions(3, 3);
    positions << -100, 100, 0, -100, -100, 100, -30, -30, 20;
    Eigen::Matrix3Xi triangles(3, 1);
    triangles << 0, 1, 2;
    Camera camera;
    camera.look_from({0, 0, 1}, {0, 1, 0});
    const auto hit = pick(camera, kView, kView.center() + Eigen::Vector2d(0, 50), positions, triangles);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->triangle, 0);
    EXPECT_LT((camera.project(hit->point, kView).pixel - kView.center() - Eigen::Vector2d(0, 50)).norm(), 1e-6);
}

}  // namespace
}  // namespace elastolab
