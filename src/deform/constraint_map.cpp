#include "deform/constraint_map.hpp"

#include <array>

namespace elastolab {

namespace {

/// Collects weights of 3 x 3 unit blocks.
class BlockWeights {
public:
    void add(int row, int column, double weight) {
        for (int axis = 0; axis < 3; ++axis) entries_.emplace_back(3 * row + axis, 3 * column + axis, weight);
    }
    SparseRows build(Eigen::Index n_rows, Eigen::Index n_columns) const {
        SparseRows matrix(3 * n_rows, 3 * n_columns);
        matrix.setFromTriplets(entries_.begin(), entries_.end());
        return matrix;
    }

private:
    std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace

ConstrainedNodes constrain_vertices(std::span<const int> vertices) {
    ConstrainedNodes constrained{{vertices.begin(), vertices.end()}, {}};
    BlockWeights weights;
    for (int i = 0; i < std::ssize(vertices); ++i) weights.add(i, i, 1.0);
    constrained.prescribe = weights.build(std::ssize(vertices), std::ssize(vertices));
    return constrained;
}

ConstrainedNodes constrain_triangles(const SurfaceMesh& mesh, const VertexTriangles& around,
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
        for (const int t : around[v]) any_whole |= is_whole(t);
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

SparseRows average_of_triangles(const SurfaceMesh& mesh, const VertexTriangles& around) {
    BlockWeights weights;
    for (int v = 0; v < mesh.n_vertices(); ++v)
        for (const int t : around[v]) weights.add(v, t, 1.0 / static_cast<double>(around[v].size()));
    return weights.build(mesh.n_vertices(), mesh.n_triangles());
}

}  // namespace elastolab
