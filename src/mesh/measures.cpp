#include "mesh/measures.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <numbers>
#include <numeric>
#include <vector>

#include "mesh/topology.hpp"

namespace elastolab {

using Eigen::Vector3d;

TrianglePoints triangle_points(const SurfaceMesh& mesh, int triangle) {
    const Eigen::Vector3i v = mesh.triangles.col(triangle);
    return {mesh.vertices.col(v[0]), mesh.vertices.col(v[1]), mesh.vertices.col(v[2])};
}

Eigen::Vector3d centroid(const SurfaceMesh& mesh, int triangle) {
    const TrianglePoints p = triangle_points(mesh, triangle);
    return (p.a + p.b + p.c) / 3.0;
}

Vector3d area_vector(const TrianglePoints& triangle) {
    return (triangle.b - triangle.a).cross(triangle.c - triangle.a);
}

double mean_edge(const SurfaceMesh& mesh) {
    const EdgeTable edges(mesh);
    double sum = 0.0;
    for (int e = 0; e < edges.size(); ++e)
        sum += (mesh.vertices.col(edges[e].a) - mesh.vertices.col(edges[e].b)).norm();
    return sum / std::max(1, edges.size());
}

double surface_area(const SurfaceMesh& mesh) {
    double area = 0.0;
    for (int t = 0; t < mesh.n_triangles(); ++t) area += 0.5 * area_vector(triangle_points(mesh, t)).norm();
    return area;
}

double enclosed_volume(const SurfaceMesh& mesh, std::span<const int> triangles) {
    if (triangles.empty()) return 0.0;
    // Volumes of cones with their apex on the surface: far from the origin, an apex at the origin would lose digits.
    const Vector3d apex = triangle_points(mesh, triangles.front()).a;
    double volume = 0.0;
    for (const int t : triangles) {
        const TrianglePoints p = triangle_points(mesh, t);
        volume += (p.a - apex).dot((p.b - apex).cross(p.c - apex)) / 6.0;
    }
    return volume;
}

double enclosed_volume(const SurfaceMesh& mesh) {
    std::vector<int> all(static_cast<std::size_t>(mesh.n_triangles()));
    std::iota(all.begin(), all.end(), 0);
    return enclosed_volume(mesh, all);
}

namespace {

double solid_angle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    return 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace

double winding_number(const SurfaceMesh& mesh, std::span<const int> triangles, const Vector3d& point) {
    double angle = 0.0;
    for (const int t : triangles) {
        const TrianglePoints p = triangle_points(mesh, t);
        angle += solid_angle(p.a - point, p.b - point, p.c - point);
    }
    return angle / (4.0 * std::numbers::pi);
}

}  // namespace elastolab
