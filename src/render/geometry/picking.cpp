#include "render/geometry/picking.hpp"

#include <algorithm>
#include <Eigen/Geometry>
#include <functional>
#include <utility>

#include "render/geometry/visibility.hpp"

namespace elastolab {

namespace {

double pixel_distance(const ProjectedPoint& seen, const Eigen::Vector2d& cursor) {
    return (seen.pixel - cursor).norm();
}

PickHit hit_on(const Camera& camera, const Viewport& viewport, const Eigen::Vector2d& cursor,
               const PositionsView& positions, const TrianglesView& triangles, const RayHit& found) {
    PickHit hit{found.triangle, found.barycentric, Eigen::Vector3d::Zero(), -1, 0.0};
    for (int i = 0; i < 3; ++i) {
        const int vertex = triangles(i, found.triangle);
        hit.point += found.barycentric[i] * positions.col(vertex);
        const ProjectedPoint seen = camera.project(positions.col(vertex), viewport);
        if (!(seen.depth > 0.0)) continue;
        const double distance = pixel_distance(seen, cursor);
        if (hit.vertex >= 0 && distance >= hit.vertex_distance) continue;
        hit.vertex = vertex;
        hit.vertex_distance = distance;
    }
    return hit;
}

/// For each vertex whether it is a corner of a triangle.
std::vector<bool> is_corner(Eigen::Index n_vertices, const TrianglesView& triangles) {
    std::vector<bool> corner(static_cast<std::size_t>(n_vertices), false);
    for (const int vertex : triangles.reshaped()) corner[static_cast<std::size_t>(vertex)] = true;
    return corner;
}

std::optional<PickHit> snapped(const Camera& camera, const Viewport& viewport, const Eigen::Vector2d& cursor,
                               const PositionsView& positions, const TrianglesView& triangles, double snap) {
    std::vector<std::pair<double, int>> near;
    for (int vertex = 0; vertex < static_cast<int>(positions.cols()); ++vertex) {
        const ProjectedPoint seen = camera.project(positions.col(vertex), viewport);
        if (seen.depth > 0.0 && pixel_distance(seen, cursor) <= snap)
            near.emplace_back(pixel_distance(seen, cursor), vertex);
    }
    if (near.empty()) return std::nullopt;
    const std::vector<bool> corner = is_corner(positions.cols(), triangles);
    std::erase_if(near, [&](const auto& found) { return !corner[static_cast<std::size_t>(found.second)]; });
    std::sort(near.begin(), near.end());
    for (const auto& [distance, vertex] : near)
        if (is_visible(camera.eye(), vertex, positions, triangles))
            return PickHit{-1, Eigen::Vector3d::Zero(), positions.col(vertex), vertex, distance};
    return std::nullopt;
}

using PixelTest = std::function<bool(const Eigen::Vector2d&)>;

std::vector<int> selected(const Camera& camera, const Viewport& viewport, const PositionsView& positions,
                          const TrianglesView& triangles, Reach reach, const PixelTest& inside) {
    const std::vector<bool> corner = is_corner(positions.cols(), triangles);
    std::vector<int> vertices;
    for (int vertex = 0; vertex < static_cast<int>(positions.cols()); ++vertex) {
        if (!corner[static_cast<std::size_t>(vertex)]) continue;
        const ProjectedPoint seen = camera.project(positions.col(vertex), viewport);
        if (seen.depth > 0.0 && inside(seen.pixel)) vertices.push_back(vertex);
    }
    return reach == Reach::through ? vertices : visible_of(vertices, camera, viewport, positions, triangles);
}

}  // namespace

std::optional<PickHit> pick(const Camera& camera, const Viewport& viewport, const Eigen::Vector2d& cursor,
                            const PositionsView& positions, const TrianglesView& triangles, double snap) {
    const Ray ray = camera.ray(cursor, viewport);
    if (const std::optional<RayHit> found = first_hit(ray, positions, triangles))
        return hit_on(camera, viewport, cursor, positions, triangles, *found);
    return snapped(camera, viewport, cursor, positions, triangles, snap);
}

std::vector<int> vertices_in_rectangle(const Camera& camera, const Viewport& viewport, const Eigen::Vector2d& corner,
                                       const Eigen::Vector2d& opposite, const PositionsView& positions,
                                       const TrianglesView& triangles, Reach reach) {
    Eigen::AlignedBox2d box(corner);
    box.extend(opposite);
    return selected(camera, viewport, positions, triangles, reach,
                    [&box](const Eigen::Vector2d& pixel) { return box.contains(pixel); });
}

std::vector<int> vertices_in_brush(const Camera& camera, const Viewport& viewport, const Eigen::Vector2d& from,
                                   const Eigen::Vector2d& to, double radius, const PositionsView& positions,
                                   const TrianglesView& triangles, Reach reach) {
    const Eigen::Vector2d way = to - from;
    const double square = way.squaredNorm();
    return selected(camera, viewport, positions, triangles, reach, [&](const Eigen::Vector2d& pixel) {
        const double part = square > 0.0 ? std::clamp((pixel - from).dot(way) / square, 0.0, 1.0) : 0.0;
        return (pixel - from - part * way).norm() <= radius;
    });
}

}  // namespace elastolab
