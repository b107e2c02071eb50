#include "fem/constraints.hpp"

#include <cassert>
#include <Eigen/Geometry>
#include <vector>

namespace elastolab {

namespace {

/// Where `measure` is largest among the first n columns.
template <class Measure>
int farthest(const Positions& positions, int n, Measure&& measure) {
    int best = 0;
    double largest = -1.0;
    for (int i = 0; i < n; ++i) {
        const double value = measure(positions.col(i));
        if (value > largest) {
            largest = value;
            best = i;
        }
    }
    return best;
}

/// Unit directions (columns) in which each node of the support is held.
std::array<Eigen::Matrix3Xd, 3> support_directions(const Positions& positions, const StaticSupport& support) {
    const Eigen::Vector3d a = positions.col(support[0]), b = positions.col(support[1]), c = positions.col(support[2]);
    const Eigen::Vector3d along = (b - a).normalized();
    const Eigen::Vector3d normal = along.cross(c - a).normalized();
    Eigen::Matrix3Xd across(3, 2);
    across << normal, along.cross(normal);
    return {Eigen::Matrix3d::Identity(), across, normal};
}

}  // namespace

StaticSupport choose_support(const Positions& positions, int n_candidates) {
    assert(n_candidates >= 3);
    const Eigen::Vector3d centre = positions.leftCols(n_candidates).rowwise().mean();
    const int a = farthest(positions, n_candidates, [&](const auto& p) { return (p - centre).squaredNorm(); });
    const Eigen::Vector3d at_a = positions.col(a);
    const int b = farthest(positions, n_candidates, [&](const auto& p) { return (p - at_a).squaredNorm(); });
    const Eigen::Vector3d along = (positions.col(b) - at_a).normalized();
    const int c = farthest(positions, n_candidates, [&](const auto& p) { return along.cross(p - at_a).squaredNorm(); });
    return {a, b, c};
}

SparseMatrix grounded(const SparseMatrix& K, const Positions& positions, const StaticSupport& support) {
    const std::array<Eigen::Matrix3Xd, 3> directions = support_directions(positions, support);
    SparseMatrix K_g = K;
    for (std::size_t node = 0; node < support.size(); ++node) {
        const int first = 3 * support[node];
        double spring = 0.0;
        for (int i = 0; i < 3; ++i) spring += K.coeff(first + i, first + i) / 3.0;
        const Eigen::Matrix3d springs = spring * directions[node] * directions[node].transpose();
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) K_g.coeffRef(first + i, first + j) += springs(i, j);
    }
    return K_g;
}

SparseMatrix eliminated(const SparseMatrix& K, std::span<const int> nodes) {
    std::vector<char> is_eliminated(static_cast<std::size_t>(K.rows()) / 3, 0);
    for (int node : nodes) is_eliminated[static_cast<std::size_t>(node)] = 1;
    const auto marked = [&](Eigen::Index dof) { return is_eliminated[static_cast<std::size_t>(dof / 3)] != 0; };
    SparseMatrix K_ff = K;  // NOLINT(performance-unnecessary-copy-initialization): changed through valueRef()
    for (int column = 0; column < K_ff.cols(); ++column)
        for (SparseMatrix::InnerIterator it(K_ff, column); it; ++it)
            if (it.row() != column && (marked(it.row()) || marked(column))) it.valueRef() = 0.0;
    return K_ff;
}

}  // namespace elastolab
