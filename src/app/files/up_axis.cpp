#include "app/files/up_axis.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/measures.hpp"

namespace elastolab {

namespace {

/// Of the surface.
Eigen::Vector3d center_of(const SurfaceMesh& mesh) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double area = 0.0;
    for (int t = 0; t < mesh.n_triangles(); ++t) {
        const double its = area_vector(triangle_points(mesh, t)).norm();
        sum += its * centroid(mesh, t);
        area += its;
    }
    return area > 0.0 ? Eigen::Vector3d(sum / area) : Eigen::Vector3d(mesh.vertices.rowwise().mean());
}

/// Whether the center is above the convex hull of the feet: no half of the directions around it is without a foot.
bool stands(const SurfaceMesh& mesh, const Eigen::Vector3d& center, int up) {
    std::vector<double> directions;
    for (const int v : lowest_vertices(mesh, Eigen::Vector3d::Unit(up), kFeet)) {
        const Eigen::Vector3d to = mesh.vertices.col(v) - center;
        directions.push_back(std::atan2(to[(up + 2) % 3], to[(up + 1) % 3]));
    }
    std::sort(directions.begin(), directions.end());
    double gap = directions.front() + 2.0 * std::numbers::pi - directions.back();
    for (std::size_t i = 1; i < directions.size(); ++i) gap = std::max(gap, directions[i] - directions[i - 1]);
    return gap < std::numbers::pi;
}

}  // namespace

std::vector<int> lowest_vertices(const SurfaceMesh& mesh, const Eigen::Vector3d& up, double part) {
    const Eigen::RowVectorXd heights = up.transpose() * mesh.vertices;
    const double limit = heights.minCoeff() + part * (heights.maxCoeff() - heights.minCoeff());
    std::vector<int> lowest;
    for (Eigen::Index v = 0; v < heights.size(); ++v)
        if (heights[v] <= limit) lowest.push_back(static_cast<int>(v));
    return lowest;
}

std::vector<int> first_held_vertices(const SurfaceMesh& mesh, const Eigen::Vector3d& up) {
    constexpr double kFlat = 1e-6;  // height over the longest side
    const Eigen::Vector3d sides = mesh.vertices.rowwise().maxCoeff() - mesh.vertices.rowwise().minCoeff();
    Eigen::Index longest = 0;
    const double length = sides.maxCoeff(&longest);
    const bool lies = std::abs(up.dot(sides)) <= kFlat * length;
    return lowest_vertices(mesh, lies ? Eigen::Vector3d::Unit(longest) : up, kFeet);
}

Eigen::Vector3d up_axis_of(const SurfaceMesh& mesh) {
    constexpr int kY = 1, kZ = 2;
    const Eigen::Vector3d center = center_of(mesh);
    return Eigen::Vector3d::Unit(stands(mesh, center, kZ) && !stands(mesh, center, kY) ? kZ : kY);
}

}  // namespace elastolab
