#include "render/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Geometry>
#include <numbers>
#include <random>
#include <vector>

#include "render/viewpoint.hpp"

namespace elastolab {
namespace {

using test::camera_at;

constexpr Viewport kPlace{40.0, 25.0, 1200.0, 800.0};
constexpr double kTight = 1e-9;  // relative to the size of the scene, and in pixels

/// Sizes and places of scenes that must all work alike.
std::vector<SceneFrame> scenes() {
    return {
        {Eigen::Vector3d::Zero(), 1.0}, {{3.0, -2.0, 5.0}, 1.0}, {{1e-9, 2e-9, 0.0}, 1e-9}, {{-4e9, 1e9, 2e9}, 1e9}};
}

class Random {
public:
    double operator()(double low, double high) { return std::uniform_real_distribution<>(low, high)(engine_); }
    Eigen::Vector2d pixel() { return {(*this)(40.0, 1240.0), (*this)(25.0, 825.0)}; }
    Eigen::Vector3d point(const SceneFrame& ball) {
        return ball.center + 0.57 * ball.radius * Eigen::Vector3d((*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1));
    }

private:
    std::mt19937 engine_{7};
};

/// kPlace, of whose width this part is covered.
Viewport partly_covered(double part) {
    Viewport place = kPlace;
    place.covered = part * place.width;
    return place;
}

double distance(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return (a - b).norm(); }

TEST(Camera, ProjectsEveryPointOfARayToItsPixel) {
    Random random;
    for (const SceneFrame& ball : scenes()) {
        const Camera camera = camera_at(ball, kPlace);
        for (int i = 0; i < 100; ++i) {
            const Eigen::Vector2d pixel = random.pixel();
            const Ray ray = camera.ray(pixel, kPlace);
            const Eigen::Vector3d point = ray.origin + ball.radius * random(0.5, 9.0) * ray.direction;
            EXPECT_NEAR(ray.direction.norm(), 1.0, 1e-14);
            EXPECT_LT(distance(camera.project(point, kPlace).pixel, pixel), kTight);
        }
    }
}

/// Lengths are the same in front and behind, and what was at the target is where it was.
TEST(Camera, OrthographicPicturesKeepLengthsAndTheSizeOfTheBody) {
    for (const SceneFrame& ball : scenes()) {
        Camera camera = camera_at(ball, kPlace);
        const auto seen = [&](double along_view, double across) {
            const Eigen::Vector3d point =
                camera.pose().target + ball.radius * (along_view * camera.backward() + across * camera.right());
            return camera.project(point, kPlace);
        };
        const double before = distance(seen(0.0, 0.0).pixel, seen(0.0, 0.7).pixel);
        camera.set_projection_kind(Projection::orthographic);
        const double middle = distance(seen(0.0, 0.0).pixel, seen(0.0, 0.7).pixel);
        EXPECT_NEAR(middle, before, 1e-6 * before);
        for (const double depth : {-0.9, 0.9}) {
            EXPECT_NEAR(distance(seen(depth, 0.0).pixel, seen(depth, 0.7).pixel), middle, 1e-3 * middle);
            EXPECT_GT(seen(depth, 0.0).depth, 0.0);
        }
        const Eigen::Vector2d pixel(300.0, 500.0);
        const Ray ray = camera.ray(pixel, kPlace);
        const Eigen::Vector3d point = ray.origin + camera.project(ball.center, kPlace).depth * ray.direction;
        EXPECT_LT(distance(camera.project(point, kPlace).pixel, pixel), 1e-5);
        toggle_projection(camera);
        EXPECT_NEAR(distance(seen(0.0, 0.0).pixel, seen(0.0, 0.7).pixel), before, kTight * before);
    }
}

TEST(Camera, OrthographicViewsFrameAndZoomAsPerspectiveOnesDo) {
    const SceneFrame ball{{3.0, -2.0, 5.0}, 1.0};
    Camera camera = camera_at(ball, kPlace);
    camera.set_projection_kind(Projection::orthographic);
    camera.frame(ball, kPlace.aspect());
    const double half = distance(camera.project(ball.center, kPlace).pixel,
                                 camera.project(ball.center + ball.radius * camera.up(), kPlace).pixel);
    EXPECT_LT(half, 0.5 * kPlace.height);
    EXPECT_GT(half, 0.4 * kPlace.height);
    const Eigen::Vector3d point = ball.center + Eigen::Vector3d(0.3, 0.2, 0.1);
    const Eigen::Vector2d cursor = camera.project(point, kPlace).pixel;
    camera.zoom_to(cursor, 2.0, point, kPlace);
    EXPECT_LT(distance(camera.project(point, kPlace).pixel, cursor), 1e-4);
    EXPECT_NEAR(distance(camera.project(point, kPlace).pixel, camera.project(point + 0.1 * camera.up(), kPlace).pixel),
                0.2 * half, 1e-3 * half);
    const Eigen::Vector3d shift = camera.drag_in_plane(point, cursor, cursor + Eigen::Vector2d(40, 30), kPlace);
    EXPECT_LT(distance(camera.project(point + shift, kPlace).pixel, cursor + Eigen::Vector2d(40, 30)), 1e-4);
}

/// However near: the whole scene keeps its lengths, and what is under the cursor stays there.
TEST(Camera, OrthographicPicturesStaySoWhereTheyAreZoomedIn) {
    for (const SceneFrame& ball : scenes())
        for (const double factor : {1e-2, 10.0, 1e3, 1e4}) {
            Camera camera = camera_at(ball, kPlace);
            camera.set_projection_kind(Projection::orthographic);
            const Eigen::Vector3d point = ball.center + ball.radius * Eigen::Vector3d(0.3, 0.2, 0.6);
            const Eigen::Vector2d cursor = camera.project(point, kPlace).pixel;
            for (int step = 0; step < 8; ++step) camera.zoom_to(cursor, std::pow(factor, 1.0 / 8.0), point, kPlace);
            EXPECT_LT(distance(camera.project(point, kPlace).pixel, cursor), 0.1) << factor;
            const double width = 0.1 * camera.pose().distance;
            const auto seen = [&](double depth) {
                const Eigen::Vector3d start = camera.pose().target + depth * ball.radius * camera.backward();
                EXPECT_GT(camera.project(start, kPlace).depth, 0.0);
                return distance(camera.project(start, kPlace).pixel,
                                camera.project(start + width * camera.up(), kPlace).pixel);
            };
            const double middle = seen(0.0);
            EXPECT_GT(middle, 1.0);
            for (const double depth : {-0.9, 0.9}) EXPECT_NEAR(seen(depth), middle, 1e-3 * middle) << factor;
        }
}

TEST(Camera, LooksAlongAxesWithTheUpAxisOnTop) {
    Camera camera = camera_at({{0, 0, 0}, 1.0}, kPlace);
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {1.0, -1.0}) {
            camera.look_along(side * Eigen::Vector3d::Unit(axis));
            EXPECT_LT((camera.backward() - side * Eigen::Vector3d::Unit(axis)).norm(), 1e-12);
            if (axis == 2) continue;
            EXPECT_LT((camera.up() - camera.up_axis()).norm(), 1e-12);
        }
}

TEST(Camera, UnprojectsWhatItProjects) {
    Random random;
    for (const SceneFrame& ball : scenes()) {
        const Camera camera = camera_at(ball, kPlace);
        const Viewport place = partly_covered(random(0.0, 0.3));
        const Eigen::Vector3d point = random.point(ball);
        const ProjectedPoint seen = camera.project(point, place);
        EXPECT_LT((camera.unproject(seen.pixel, seen.depth, place) - point).norm(), kTight * ball.radius);
    }
}

TEST(Camera, AgreesWithItsMatrices) {
    Random random;
    for (const SceneFrame& ball : scenes()) {
        const Camera camera = camera_at(ball, kPlace);
        const Viewport place = partly_covered(random(0.0, 0.3));
        const Eigen::Vector3d point = random.point(ball);
        const Eigen::Vector4d clip = camera.projection(place) * camera.view() * point.homogeneous();
        const Eigen::Vector3d ndc = clip.head<3>() / clip.w();
        const Eigen::Vector2d pixel(kPlace.x + 0.5 * (1.0 + ndc.x()) * kPlace.width,
                                    kPlace.y + 0.5 * (1.0 - ndc.y()) * kPlace.height);
        EXPECT_LT(distance(camera.project(point, place).pixel, pixel), 1e-6);
        EXPECT_LT(std::abs(ndc.z()), 1.0);
    }
}

TEST(Camera, KeepsADraggedPointUnderTheCursor) {
    Random random;
    for (const SceneFrame& ball : scenes()) {
        const Camera camera = camera_at(ball, kPlace);
        for (int i = 0; i < 100; ++i) {
            const Eigen::Vector3d anchor = random.point(ball);
            const ProjectedPoint from = camera.project(anchor, kPlace);
            const Eigen::Vector2d to = random.pixel();
            const Eigen::Vector3d moved = anchor + camera.drag_in_plane(anchor, from.pixel, to, kPlace);
            const ProjectedPoint seen = camera.project(moved, kPlace);
            EXPECT_LT(distance(seen.pixel, to), 1e-6);
            EXPECT_NEAR(seen.depth, from.depth, kTight * ball.radius);
        }
    }
}

TEST(Camera, PansThePlaneOfItsTargetWithTheCursor) {
    for (const SceneFrame& ball : scenes()) {
        Camera camera = camera_at(ball, kPlace);
        const Eigen::Vector2d from(300, 200), to(900, 640);
        const Eigen::Vector3d point = camera.unproject(from, camera.pose().distance, kPlace);
        camera.pan(from, to, kPlace);
        EXPECT_LT(distance(camera.project(point, kPlace).pixel, to), 1e-6);
    }
}

TEST(Camera, ZoomsAboutThePointUnderTheCursor) {
    Random random;
    for (const SceneFrame& ball : scenes()) {
        Camera camera = camera_at(ball, kPlace);
        const Eigen::Vector2d cursor = random.pixel();
        const Eigen::Vector3d anchor = random.point(ball);
        const double depth = camera.project(anchor, kPlace).depth, distance_before = camera.pose().distance;
        const Eigen::Vector3d point = camera.unproject(cursor, depth, kPlace);
        camera.zoom_to(cursor, 1.5, anchor, kPlace);
        EXPECT_LT(distance(camera.project(point, kPlace).pixel, cursor), 1e-6);
        EXPECT_NEAR(camera.pose().distance, distance_before / 1.5, 1e-12 * distance_before);
    }
}

TEST(Camera, StopsZoomingBeforeItLosesTheScene) {
    Camera camera = camera_at({}, kPlace);
    for (int i = 0; i < 1000; ++i) camera.zoom_to(kPlace.center(), 1.2, Eigen::Vector3d::Zero(), kPlace);
    EXPECT_GT(camera.pose().distance, 0.99e-4);
    for (int i = 0; i < 1000; ++i) camera.zoom_to(kPlace.center(), 0.8, Eigen::Vector3d::Zero(), kPlace);
    EXPECT_LT(camera.pose().distance, 1.01e3);
}

TEST(Camera, FramesABallThatTouchesNoBorder) {
    for (const SceneFrame& ball : scenes())
        for (const Viewport& viewport : {Viewport{0, 0, 1200, 500}, Viewport{0, 0, 500, 1200}}) {
            Camera camera = camera_at(ball, kPlace);
            camera.frame(ball, viewport.aspect());
            const double reach = ball.radius / std::sin(std::acos(ball.radius / camera.pose().distance));
            const double shorter = std::min(viewport.width, viewport.height);
            const ProjectedPoint side = camera.project(ball.center + reach * camera.right(), viewport);
            EXPECT_LT(distance(side.pixel, viewport.center()), 0.5 * shorter);
            EXPECT_GT(distance(side.pixel, viewport.center()), 0.45 * shorter);
        }
}

TEST(Camera, OrbitKeepsTheUpAxisUprightAndStopsAtThePoles) {
    Random random;
    Camera camera = camera_at({}, kPlace);
    for (int i = 0; i < 500; ++i) {
        camera.orbit(random(-80, 80), random(-80, 80), kPlace);
        EXPECT_NEAR(camera.right().dot(camera.up_axis()), 0.0, 1e-9);
        EXPECT_GT(camera.up().dot(camera.up_axis()), -1e-9);
    }
    camera.orbit(0.0, 1e5, kPlace);
    EXPECT_NEAR(camera.backward().z(), 1.0, kTight);
    camera.orbit(0.0, -1e5, kPlace);
    EXPECT_NEAR(camera.backward().z(), -1.0, kTight);
}

TEST(Camera, StaysUprightAtThePolesHoweverOftenItIsTurnedThere) {
    Random random;
    for (const double way : {1.0, -1.0}) {
        Camera camera = camera_at({}, kPlace);
        for (int i = 0; i < 2000; ++i) {
            camera.orbit(random(-80, 80), way * random(-1, 80), kPlace);
            ASSERT_GT(camera.up().dot(camera.up_axis()), -1e-12) << i;
        }
    }
}

TEST(Camera, TurnsTheSceneTheWayThatItIsDragged) {
    const Eigen::Vector3d front(0.0, -1.0, 0.0);
    Camera camera;
    camera.set_view(ViewDirection::front);
    const Eigen::Vector2d before = camera.project(front, kPlace).pixel;
    camera.orbit(30.0, 20.0, kPlace);
    const Eigen::Vector2d after = camera.project(front, kPlace).pixel;
    EXPECT_GT(after.x(), before.x() + 10.0);
    EXPECT_GT(after.y(), before.y() + 5.0);
}

TEST(Camera, LooksFromTheNamedDirections) {
    Camera camera;
    camera.set_view(ViewDirection::front);
    EXPECT_TRUE(camera.backward().isApprox(Eigen::Vector3d(0, -1, 0), kTight));
    EXPECT_TRUE(camera.right().isApprox(Eigen::Vector3d(1, 0, 0), kTight));
    camera.set_view(ViewDirection::right);
    EXPECT_TRUE(camera.backward().isApprox(Eigen::Vector3d(1, 0, 0), kTight));
    camera.set_view(ViewDirection::top);
    EXPECT_TRUE(camera.right().isApprox(Eigen::Vector3d(1, 0, 0), kTight));
    camera.set_up_axis(Eigen::Vector3d::UnitY());
    camera.set_view(ViewDirection::front);
    EXPECT_TRUE(camera.backward().isApprox(Eigen::Vector3d(0, 0, 1), kTight));
    EXPECT_TRUE(camera.right().isApprox(Eigen::Vector3d(1, 0, 0), kTight));
}

TEST(Camera, FitsPointsSoThatTheyTouchTheMarginAndNoneIsOutside) {
    Camera camera;
    camera.set_scene({Eigen::Vector3d(5, 5, 5), 2.0});
    camera.set_view(ViewDirection::isometric);
    std::srand(7);
    const Eigen::Matrix3Xd points = Eigen::Vector3d(1, 2, 0.3).asDiagonal() * Eigen::Matrix3Xd::Random(3, 50);
    for (const Viewport& viewport : {Viewport{0, 0, 900, 300}, Viewport{0, 0, 300, 900}}) {
        camera.fit(points, viewport.aspect());
        Eigen::Vector2d farthest(0, 0);
        for (const auto& point : points.colwise()) {
            const Eigen::Vector2d d = camera.project(point, viewport).pixel - viewport.center();
            farthest =
                farthest.cwiseMax(d.cwiseAbs().cwiseQuotient(0.5 * Eigen::Vector2d(viewport.width, viewport.height)));
        }
        EXPECT_NEAR(farthest.maxCoeff(), 0.86, 1e-9);
    }
}

TEST(Camera, KeepsABodyClearOfWhatCoversTheRightOfTheViewport) {
    Camera camera;
    camera.set_scene({Eigen::Vector3d::Zero(), 2.0});
    camera.set_view(ViewDirection::isometric);
    std::srand(7);
    const Eigen::Matrix3Xd points = Eigen::Vector3d(1, 2, 0.3).asDiagonal() * Eigen::Matrix3Xd::Random(3, 50);
    const Viewport viewport{0, 0, 600, 500, 120};
    camera.fit(points, viewport.free_aspect());
    for (const auto& point : points.colwise()) {
        const double x = camera.project(point, viewport).pixel.x();
        EXPECT_GT(x, 0.0);
        EXPECT_LT(x, 0.8 * viewport.width);
    }
    EXPECT_NEAR(camera.project(camera.pose().target, viewport).pixel.x(), 0.4 * viewport.width, 1e-9);
}

}  // namespace
}  // namespace elastolab
