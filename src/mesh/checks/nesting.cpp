#include "mesh/checks/nesting.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "mesh/box_tree.hpp"
#include "mesh/measures.hpp"

namespace elastolab {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

AlignedBox3d bounding_box(const SurfaceMesh& mesh, std::span<const int> triangles) {
    AlignedBox3d box;
    for (const int t : triangles)
        for (const int v : mesh.triangles.col(t)) box.extend(Vector3d(mesh.vertices.col(v)));
    return box;
}

namespace {

/// Boxes for a tree: triangle i has the corners of box i.
SurfaceMesh as_triangles(const std::vector<AlignedBox3d>& boxes) {
    const auto n = static_cast<Eigen::Index>(boxes.size());
    SurfaceMesh mesh{Eigen::Matrix3Xd(3, 2 * n), Eigen::Matrix3Xi(3, n)};
    for (Eigen::Index i = 0; i < n; ++i) {
        mesh.vertices.col(2 * i) = boxes[static_cast<std::size_t>(i)].min();
        mesh.vertices.col(2 * i + 1) = boxes[static_cast<std::size_t>(i)].max();
        const auto corner = static_cast<int>(2 * i);
        mesh.triangles.col(i) << corner, corner + 1, corner;
    }
    return mesh;
}

Vector3d point_on(const SurfaceMesh& mesh, std::span<const int> triangles) {
    const TrianglePoints p = triangle_points(mesh, triangles.front());
    return (p.a + p.b + p.c) / 3.0;
}

}  // namespace

std::vector<std::vector<int>> surfaces_around(const SurfaceMesh& mesh, const std::vector<std::vector<int>>& components,
                                              const std::function<bool(int, int)>& apart) {
    std::vector<AlignedBox3d> boxes;
    for (const auto& triangles : components) boxes.push_back(bounding_box(mesh, triangles));
    std::vector<std::vector<int>> around(components.size());
    if (components.size() < 2) return around;
    std::vector<int> all(components.size());
    std::iota(all.begin(), all.end(), 0);
    std::erase_if(all, [&](int d) { return !boxes[static_cast<std::size_t>(d)].diagonal().allFinite(); });
    const BoxTree tree(as_triangles(boxes), std::move(all));  // there may be a hundred thousand of them
    for (std::size_t c = 0; c < components.size(); ++c) {
        const auto visit = [&](int other) {
            const auto d = static_cast<std::size_t>(other);
            if (c == d || !boxes[d].contains(boxes[c]) || apart(static_cast<int>(c), other)) return;
            const double winding = winding_number(mesh, components[d], point_on(mesh, components[c]));
            if (std::abs(winding) > 0.5) around[c].push_back(other);
        };
        tree.for_each_near(
            boxes[c].min(), [](double) { return 0.0; }, visit);
        std::sort(around[c].begin(), around[c].end());
    }
    return around;
}

}  // namespace elastolab
