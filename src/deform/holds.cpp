#include "deform/holds.hpp"

#include "base/lapack.hpp"

namespace elastolab {

bool holds(const Positions& positions, std::span<const int> nodes) {
    constexpr double kLeastSpread = 1e-6;
    if (nodes.size() < 3) return false;
    const Eigen::Vector3d centre = positions.rowwise().mean();
    const double body = (positions.colwise() - centre).colwise().norm().maxCoeff();
    Eigen::Matrix3Xd points(3, std::ssize(nodes));
    for (std::size_t i = 0; i < nodes.size(); ++i) points.col(static_cast<Eigen::Index>(i)) = positions.col(nodes[i]);
    points.colwise() -= points.rowwise().mean().eval();
    // Not on one line means spread in a second direction. Its square is accurate to 1e-16 of the largest; the least
    // that counts is 1e-12 of the body's.
    const Eigen::Matrix3d squared = points * points.transpose();
    return symmetric_eigen(squared).values[1] > kLeastSpread * kLeastSpread * body * body;
}

}  // namespace elastolab
