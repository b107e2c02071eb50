#include "mesh/closest_point.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "mesh/measures.hpp"

namespace elastolab {

namespace {

using Eigen::Vector3d;

constexpr int kPointsAtATime = 512;

BoxTree tree_of_all(const SurfaceMesh& mesh) {
    std::vector<int> all(static_cast<std::size_t>(mesh.n_triangles()));
    std::iota(all.begin(), all.end(), 0);
    return {mesh, std::move(all)};
}

/// The closest point of the edge from corner `i` to the next, as weights of the corners.
Vector3d closest_on_edge(const Vector3d& point, const TrianglePoints& p, int i) {
    const std::array<Vector3d, 3> corners = {p.a, p.b, p.c};
    const int j = (i + 1) % 3;
    const Vector3d& from = corners[static_cast<std::size_t>(i)];
    const Vector3d edge = corners[static_cast<std::size_t>(j)] - from;
    const double length = edge.squaredNorm();
    const double s = length > 0.0 ? std::clamp((point - from).dot(edge) / length, 0.0, 1.0) : 0.0;
    Vector3d weights = Vector3d::Zero();
    weights[i] = 1.0 - s;
    weights[j] = s;
    return weights;
}

}  // namespace

SurfacePoint closest_in_triangle(const Vector3d& point, const SurfaceMesh& mesh, int triangle) {
    const TrianglePoints p = triangle_points(mesh, triangle);
    const auto place = [&](const Vector3d& w) -> Vector3d { return w[0] * p.a + w[1] * p.b + w[2] * p.c; };
    const Vector3d n = area_vector(p);
    const double area = n.squaredNorm();
    SurfacePoint result{triangle, Vector3d::Zero(), 0.0};
    double least = std::numeric_limits<double>::infinity();  // squared
    const auto offer = [&](const Vector3d& weights) {
        const double squared = (place(weights) - point).squaredNorm();
        if (!(squared < least)) return;
        result.weights = weights;
        least = squared;
    };
    if (area > 0.0) {
        const Vector3d weights = Vector3d(n.dot((p.c - p.b).cross(point - p.b)), n.dot((p.a - p.c).cross(point - p.c)),
                                          n.dot((p.b - p.a).cross(point - p.a))) /
                                 area;
        if (weights.minCoeff() >= 0.0) offer(weights / weights.sum());
    }
    if (least == std::numeric_limits<double>::infinity())
        for (int i = 0; i < 3; ++i) offer(closest_on_edge(point, p, i));
    result.distance = std::sqrt(least);
    return result;
}

ClosestPoint::ClosestPoint(const SurfaceMesh& mesh) : mesh_(mesh), tree_(tree_of_all(mesh)) {}

SurfacePoint ClosestPoint::operator()(const Vector3d& point, int near) const {
    SurfacePoint best = closest_in_triangle(point, mesh_, near);
    tree_.for_each_near(
        point, [&](double) { return best.distance; },
        [&](int t) {
            const SurfacePoint found = closest_in_triangle(point, mesh_, t);
            if (found.distance < best.distance) best = found;
        });
    return best;
}

SurfacePlaces closest_points(const SurfaceMesh& mesh, const Positions& points, Control& control) {
    const ClosestPoint closest(mesh);
    SurfacePlaces places{Triangles(3, points.cols()), Eigen::Matrix3Xd(3, points.cols()),
                         Eigen::VectorXd(points.cols())};
    parallel_blocks(static_cast<int>(points.cols()), kPointsAtATime, control, [&](int begin, int end) {
        int near = 0;  // the neighbours in a list are mostly neighbours in space
        for (int i = begin; i < end; ++i) {
            const SurfacePoint found = closest(points.col(i), near);
            near = found.triangle;
            places.nodes.col(i) = mesh.triangles.col(found.triangle);
            places.weights.col(i) = found.weights;
            places.distance[i] = found.distance;
        }
    });
    return places;
}

}  // namespace elastolab
