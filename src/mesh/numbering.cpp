#include "mesh/numbering.hpp"

#include <algorithm>

namespace elastolab {

std::vector<int> each_once(std::vector<int> numbers) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    return numbers;
}

std::vector<int> used_vertices(const Eigen::Ref<const Eigen::MatrixXi>& corners) {
    const auto all = corners.reshaped();
    return each_once(std::vector<int>(all.begin(), all.end()));
}

void renumber(Eigen::Ref<Eigen::MatrixXi> corners, const std::vector<int>& vertices) {
    for (int& vertex : corners.reshaped())
        vertex = static_cast<int>(std::lower_bound(vertices.begin(), vertices.end(), vertex) - vertices.begin());
}

SurfaceMesh without_unused(const SurfaceMesh& mesh) {
    // Not by used_vertices and renumber, which sort: scans have millions of triangles.
    std::vector<int> number(static_cast<std::size_t>(mesh.n_vertices()), -1), used;
    for (const int v : mesh.triangles.reshaped()) number[static_cast<std::size_t>(v)] = 0;
    for (int v = 0; v < mesh.n_vertices(); ++v)
        if (int& own = number[static_cast<std::size_t>(v)]; own == 0) {
            own = static_cast<int>(used.size());
            used.push_back(v);
        }
    SurfaceMesh result{mesh.vertices(Eigen::all, used), mesh.triangles};
    for (int& v : result.triangles.reshaped()) v = number[static_cast<std::size_t>(v)];
    return result;
}

}  // namespace elastolab
