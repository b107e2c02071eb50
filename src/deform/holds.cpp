#include "deform/holds.hpp"

#include <Eigen/SVD>

namespace elastolab {

bool holds(const Positions& positions, std::span<const int> nodes) {
    constexpr double kLeastSpread = 1e-6;
    if (nodes.size() < 3) return false;
    const double body = (positions.colwise() - positions.rowwise().mean()).colwise().norm().maxCoeff();
    Eigen::Matrix3Xd points(3, std::ssize(nodes));
    for (std::size_t i = 0; i < nodes.size(); ++i) points.col(static_cast<Eigen::Index>(i)) = positions.col(nodes[i]);
    points.colwise() -= points.rowwise().mean().eval();
    // Off a line means a second direction of spread: the second singular value.
    const Eigen::Vector3d spread = Eigen::JacobiSVD<Eigen::Matrix3Xd>(points).singularValues();
    return spread[1] > kLeastSpread * body;
}

}  // namespace elastolab
