#include "mesh/checks/nesting.hpp"

#include <cmath>

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
    for (std::size_t c = 0; c < components.size(); ++c)
        for (std::size_t d = 0; d < components.size(); ++d) {
            if (c == d || !boxes[d].contains(boxes[c]) || apart(static_cast<int>(c), static_cast<int>(d))) continue;
            const double winding = winding_number(mesh, components[d], point_on(mesh, components[c]));
            if (std::abs(winding) > 0.5) around[c].push_back(static_cast<int>(d));
        }
    return around;
}

}  // namespace elastolab
