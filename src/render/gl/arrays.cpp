#include "render/gl/arrays.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace elastolab {

Edges edges_of(const TrianglesView& triangles) {
    std::vector<std::pair<int, int>> edges;
    edges.reserve(static_cast<std::size_t>(3 * triangles.cols()));
    for (Eigen::Index t = 0; t < triangles.cols(); ++t)
        for (int i = 0; i < 3; ++i) edges.emplace_back(std::minmax({triangles(i, t), triangles((i + 1) % 3, t)}));
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    Edges result(2, static_cast<Eigen::Index>(edges.size()));
    for (Eigen::Index i = 0; i < result.cols(); ++i) {
        const auto& [first, second] = edges[static_cast<std::size_t>(i)];
        result.col(i) << first, second;
    }
    return result;
}

}  // namespace elastolab
