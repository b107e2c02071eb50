#include "bem/galerkin/hat_curls.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

namespace elastolab {

std::vector<int> triangles_along_a_curve(const Boundary& boundary, const std::vector<int>& triangles) {
    constexpr int kBits = 20;
    const Positions& vertices = boundary.mesh().vertices;
    const Eigen::Array3d low = vertices.rowwise().minCoeff(), high = vertices.rowwise().maxCoeff();
    const double step = std::max((high - low).maxCoeff(), 1e-300) / ((1 << kBits) - 1);
    std::vector<std::pair<std::uint64_t, int>> keys;
    for (const int t : triangles) {
        const Eigen::Array3d cell = (Eigen::Map<const Eigen::Array3d>(boundary.triangle(t).centroid) - low) / step;
        std::uint64_t key = 0;
        for (int bit = kBits - 1; bit >= 0; --bit)
            for (int axis = 0; axis < 3; ++axis) key = 2 * key + ((static_cast<std::uint64_t>(cell[axis]) >> bit) & 1u);
        keys.emplace_back(key, t);
    }
    std::sort(keys.begin(), keys.end());
    std::vector<int> order;
    for (const auto& [key, t] : keys) order.push_back(t);
    return order;
}

std::vector<int> triangles_along_a_curve(const Boundary& boundary) {
    std::vector<int> all(static_cast<std::size_t>(boundary.n_triangles()));
    std::iota(all.begin(), all.end(), 0);
    return triangles_along_a_curve(boundary, all);
}

Eigen::Matrix3d hat_curls(const TriangleGeometry& triangle) {
    Eigen::Matrix3d curls;
    for (int k = 0; k < 3; ++k) {
        const Eigen::Map<const Eigen::Vector3d> from(triangle.corner[(k + 1) % 3]), to(triangle.corner[(k + 2) % 3]);
        curls.col(k) = (from - to) / triangle.double_area;
    }
    return curls;
}

}  // namespace elastolab
