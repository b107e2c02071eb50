#include "mesh/closest_point.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "mesh/meshes.hpp"

namespace elastolab {
namespace {

Eigen::Vector3d place_of(const SurfaceMesh& mesh, const SurfacePoint& point) {
    return mesh.vertices(Eigen::all, mesh.triangles.col(point.triangle)) * point.weights;
}

/// Distance from a triangle by trying points of it, never too small.
double sampled_distance(const Eigen::Vector3d& x, const SurfaceMesh& mesh, int steps) {
    double least = std::numeric_limits<double>::infinity();
    for (int t = 0; t < mesh.n_triangles(); ++t)
        for (int i = 0; i <= steps; ++i)
            for (int j = 0; i + j <= steps; ++j) {
                const Eigen::Vector3d w(i, j, steps - i - j);
                const Eigen::Vector3d y = mesh.vertices(Eigen::all, mesh.triangles.col(t)) * (w / steps);
                least = std::min(least, (x - y).norm());
            }
    return least;
}

TEST(ClosestPoint, NoPointOfTheSurfaceIsCloser) {
    const SurfaceMesh mesh = make_lumpy_ball(2);
    const ClosestPoint closest(mesh);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> coordinate(-2.0, 2.0);
    for (int i = 0; i < 40; ++i) {
        const Eigen::Vector3d x(coordinate(random), coordinate(random), coordinate(random));
        const SurfacePoint found = closest(x, i % mesh.n_triangles());
        EXPECT_NEAR((place_of(mesh, found) - x).norm(), found.distance, 1e-12);
        EXPECT_NEAR(found.weights.sum(), 1.0, 1e-14);
        EXPECT_GE(found.weights.minCoeff(), 0.0);
        const double sampled = sampled_distance(x, mesh, 12);
        EXPECT_LE(found.distance, sampled + 1e-12);
        EXPECT_GE(found.distance, sampled - 0.05);
    }
}

TEST(ClosestPoint, TrianglesWithoutAreaCountAsTheirEdgesAndCorners) {
    SurfaceMesh mesh{Positions(3, 3), Triangles(3, 2)};
    mesh.vertices << 0, 1, 4, 0, 0, 0, 0, 0, 0;
    mesh.triangles << 0, 2, 1, 2, 2, 2;
    const SurfacePoint on_edge = ClosestPoint(mesh)({0.25, 3.0, 0.0});
    EXPECT_DOUBLE_EQ(on_edge.distance, 3.0);
    EXPECT_NEAR(place_of(mesh, on_edge).x(), 0.25, 1e-15);
    EXPECT_DOUBLE_EQ(closest_in_triangle({5.0, 0.0, 0.0}, mesh, 1).distance, 1.0);
}

TEST(ClosestPoint, ManyPointsAtOnceAreThoseOneByOne) {
    const SurfaceMesh mesh = make_sphere(6);
    const Positions points = 1.3 * make_lumpy_ball(9).vertices;
    Control control;
    const SurfacePlaces places = closest_points(mesh, points, control);
    const ClosestPoint closest(mesh);
    for (int i = 0; i < static_cast<int>(points.cols()); ++i)
        EXPECT_DOUBLE_EQ(places.distance[i], closest(points.col(i)).distance);
}

}  // namespace
}  // namespace elastolab
