#include "bem/space_curve.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

namespace elastolab {

std::vector<int> along_a_curve(const Positions& points) {
    constexpr int kBits = 20;
    if (points.cols() == 0) return {};
    const Eigen::Array3d low = points.rowwise().minCoeff(), high = points.rowwise().maxCoeff();
    const double step = std::max((high - low).maxCoeff(), 1e-300) / ((1 << kBits) - 1);
    std::vector<std::pair<std::uint64_t, int>> keys;
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
        const Eigen::Array3d cell = (points.col(i).array() - low) / step;
        std::uint64_t key = 0;
        for (int bit = kBits - 1; bit >= 0; --bit)
            for (int axis = 0; axis < 3; ++axis) key = 2 * key + ((static_cast<std::uint64_t>(cell[axis]) >> bit) & 1u);
        keys.emplace_back(key, static_cast<int>(i));
    }
    std::sort(keys.begin(), keys.end());
    std::vector<int> order;
    for (const auto& [key, i] : keys) order.push_back(i);
    return order;
}

std::vector<int> triangles_along_a_curve(const Boundary& boundary, std::span<const int> triangles) {
    Positions centroids(3, std::ssize(triangles));
    for (std::size_t i = 0; i < triangles.size(); ++i)
        centroids.col(static_cast<Eigen::Index>(i)) =
            Eigen::Map<const Eigen::Vector3d>(boundary.triangle(triangles[i]).centroid);
    std::vector<int> order;
    for (const int i : along_a_curve(centroids)) order.push_back(triangles[static_cast<std::size_t>(i)]);
    return order;
}

std::vector<int> triangles_along_a_curve(const Boundary& boundary) {
    std::vector<int> all(static_cast<std::size_t>(boundary.n_triangles()));
    std::iota(all.begin(), all.end(), 0);
    return triangles_along_a_curve(boundary, all);
}

}  // namespace elastolab
