#include "mesh/surface_distance.hpp"

#include <algorithm>
#include <Eigen/Geometry>

#include "mesh/measures.hpp"

namespace elastolab {

namespace {

using Eigen::Vector3d;

/// Two sides face each other when the cosine of the angle between their normals is below minus this.
constexpr double kFacing = 0.5;

double distance_to_segment(const Vector3d& x, const Vector3d& a, const Vector3d& b) {
    const Vector3d edge = b - a;
    const double s = std::clamp((x - a).dot(edge) / std::max(edge.squaredNorm(), 1e-300), 0.0, 1.0);
    return (x - a - s * edge).norm();
}

/// A triangle and a ball around it.
struct Ball {
    Vector3d centre, normal;
    double radius, longest_edge;
};

std::vector<Ball> balls_of(const SurfaceMesh& mesh) {
    std::vector<Ball> balls;
    for (int t = 0; t < mesh.n_triangles(); ++t) {
        const TrianglePoints p = triangle_points(mesh, t);
        const Vector3d centre = (p.a + p.b + p.c) / 3.0;
        balls.push_back({centre, area_vector(p).normalized(),
                         std::max({(p.a - centre).norm(), (p.b - centre).norm(), (p.c - centre).norm()}),
                         std::max({(p.b - p.a).norm(), (p.c - p.b).norm(), (p.a - p.c).norm()})});
    }
    return balls;
}

/// The mean normal of a vertex, weighted by area: not of unit length.
Eigen::Matrix3Xd vertex_normals(const SurfaceMesh& mesh) {
    Eigen::Matrix3Xd normals = Eigen::Matrix3Xd::Zero(3, mesh.n_vertices());
    for (int t = 0; t < mesh.n_triangles(); ++t)
        for (const int v : mesh.triangles.col(t)) normals.col(v) += area_vector(triangle_points(mesh, t));
    return normals;
}

Eigen::AlignedBox3d box_of(const SurfaceMesh& mesh, const std::vector<int>& vertices, double margin) {
    Eigen::AlignedBox3d box;
    for (const int v : vertices) box.extend(mesh.vertices.col(v));
    return {box.min() - Vector3d::Constant(margin), box.max() + Vector3d::Constant(margin)};
}

}  // namespace

double distance_to_triangle(const Vector3d& point, const SurfaceMesh& mesh, int triangle) {
    const TrianglePoints p = triangle_points(mesh, triangle);
    const Vector3d n = area_vector(p);
    const bool above = n.dot((p.b - p.a).cross(point - p.a)) >= 0.0 && n.dot((p.c - p.b).cross(point - p.b)) >= 0.0 &&
                       n.dot((p.a - p.c).cross(point - p.c)) >= 0.0;
    if (above) return std::abs(n.dot(point - p.a)) / n.norm();
    return std::min({distance_to_segment(point, p.a, p.b), distance_to_segment(point, p.b, p.c),
                     distance_to_segment(point, p.c, p.a)});
}

Approach closest_facing_approach(const SurfaceMesh& mesh) {
    const std::vector<Ball> balls = balls_of(mesh);
    const Eigen::Matrix3Xd normals = vertex_normals(mesh).colwise().normalized();
    Approach closest;
    for (int v = 0; v < mesh.n_vertices(); ++v) {
        const Vector3d x = mesh.vertices.col(v), normal = normals.col(v);
        for (int t = 0; t < mesh.n_triangles(); ++t) {
            const Ball& ball = balls[static_cast<std::size_t>(t)];
            const double limit = std::min(closest.ratio, 1.0) * ball.longest_edge + ball.radius;
            if ((ball.centre - x).squaredNorm() > limit * limit || ball.normal.dot(normal) > -kFacing) continue;
            if ((mesh.triangles.col(t).array() == v).any()) continue;
            const double ratio = distance_to_triangle(x, mesh, t) / ball.longest_edge;
            if (ratio < closest.ratio) closest = {ratio, v};
        }
    }
    return closest;
}

std::optional<Contact> find_contact(const SurfaceMesh& mesh, std::span<const std::vector<int>> parts, double distance) {
    std::vector<std::size_t> part_of(static_cast<std::size_t>(mesh.n_vertices()), parts.size());
    std::vector<Eigen::AlignedBox3d> boxes;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        for (const int v : parts[p]) part_of[static_cast<std::size_t>(v)] = p;
        boxes.push_back(box_of(mesh, parts[p], distance));
    }
    const std::vector<Ball> balls = balls_of(mesh);
    for (int t = 0; t < mesh.n_triangles(); ++t) {
        const std::size_t own = part_of[static_cast<std::size_t>(mesh.triangles(0, t))];
        const Ball& ball = balls[static_cast<std::size_t>(t)];
        for (std::size_t p = 0; p < parts.size(); ++p) {
            if (p == own || boxes[p].exteriorDistance(ball.centre) > ball.radius) continue;
            for (const int v : parts[p])
                if ((mesh.vertices.col(v) - ball.centre).norm() < ball.radius + distance &&
                    distance_to_triangle(mesh.vertices.col(v), mesh, t) < distance)
                    return Contact{std::min(own, p), std::max(own, p), v};
        }
    }
    return std::nullopt;
}

}  // namespace elastolab
