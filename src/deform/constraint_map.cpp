#include "deform/constraint_map.hpp"

namespace elastolab {

SparseRows BlockWeights::build(Eigen::Index n_rows, Eigen::Index n_columns) const {
    SparseRows matrix(3 * n_rows, 3 * n_columns);
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    return matrix;
}

std::vector<int> joined(std::span<const int> fixed, std::span<const int> handles) {
    std::vector<int> vertices(fixed.begin(), fixed.end());
    vertices.insert(vertices.end(), handles.begin(), handles.end());
    return vertices;
}

ConstrainedNodes constrain_vertices(std::span<const int> vertices) {
    ConstrainedNodes constrained{{vertices.begin(), vertices.end()}, {}};
    BlockWeights weights;
    for (int i = 0; i < std::ssize(vertices); ++i) weights.add(i, i, 1.0);
    constrained.prescribe = weights.build(std::ssize(vertices), std::ssize(vertices));
    return constrained;
}

}  // namespace elastolab
