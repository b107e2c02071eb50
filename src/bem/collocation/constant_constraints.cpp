#include "bem/collocation/constant_constraints.hpp"

namespace elastolab {

ConstrainedNodes constrain_triangles(const SurfaceMesh& mesh, const VertexTriangles& triangles_of_vertex,
                                     std::span<const int> vertices) {
    std::vector<int> number(static_cast<std::size_t>(mesh.n_vertices()), -1);
    for (std::size_t i = 0; i < vertices.size(); ++i)
        number[static_cast<std::size_t>(vertices[i])] = static_cast<int>(i);
    const auto constrained_corners = [&](int t) {
        std::vector<int> corners;
        for (const int v : mesh.triangles.col(t))
            if (number[static_cast<std::size_t>(v)] >= 0) corners.push_back(v);
        return corners;
    };
    const auto is_whole = [&](int t) { return constrained_corners(t).size() == 3; };
    std::vector<char> isolated(static_cast<std::size_t>(mesh.n_vertices()), 0);
    for (const int v : vertices) {
        bool any_whole = false;
        for (const int t : triangles_of_vertex[v]) any_whole |= is_whole(t);
        isolated[static_cast<std::size_t>(v)] = !any_whole;
    }

    ConstrainedNodes constrained;
    BlockWeights weights;
    for (int t = 0; t < mesh.n_triangles(); ++t) {
        std::vector<int> corners = constrained_corners(t);
        if (corners.size() < 3) std::erase_if(corners, [&](int v) { return !isolated[static_cast<std::size_t>(v)]; });
        if (corners.empty()) continue;
        const int row = static_cast<int>(constrained.nodes.size());
        for (const int v : corners)
            weights.add(row, number[static_cast<std::size_t>(v)], 1.0 / static_cast<double>(corners.size()));
        constrained.nodes.push_back(t);
    }
    constrained.prescribe = weights.build(std::ssize(constrained.nodes), std::ssize(vertices));
    return constrained;
}

SparseRows average_of_triangles(const SurfaceMesh& mesh, const VertexTriangles& triangles_of_vertex) {
    BlockWeights weights;
    for (int v = 0; v < mesh.n_vertices(); ++v)
        for (const int t : triangles_of_vertex[v])
            weights.add(v, t, 1.0 / static_cast<double>(triangles_of_vertex[v].size()));
    return weights.build(mesh.n_vertices(), mesh.n_triangles());
}

}  // namespace elastolab
