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

}  // namespace elastolab
