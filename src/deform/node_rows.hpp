#pragma once

#include <Eigen/Core>
#include <span>

namespace elastolab {

/// The rows of some nodes (or other items that have three each), in this order: 3*nodes.size() x m of 3*n_nodes x m.
inline Eigen::MatrixXd rows_of(const Eigen::MatrixXd& all, std::span<const int> nodes) {
    Eigen::MatrixXd rows(3 * std::ssize(nodes), all.cols());
    for (std::size_t i = 0; i < nodes.size(); ++i)
        rows.middleRows<3>(3 * static_cast<Eigen::Index>(i)) = all.middleRows<3>(3 * nodes[i]);
    return rows;
}

/// And back: the first rows go to those nodes.
inline void put_rows(const Eigen::MatrixXd& rows, std::span<const int> nodes, Eigen::MatrixXd& all) {
    for (std::size_t i = 0; i < nodes.size(); ++i)
        all.middleRows<3>(3 * nodes[i]) = rows.middleRows<3>(3 * static_cast<Eigen::Index>(i));
}

inline void clear_rows(std::span<const int> nodes, Eigen::MatrixXd& all) {
    for (const int node : nodes) all.middleRows<3>(3 * node).setZero();
}

/// Unit forces at some of n_nodes nodes, a column for each axis of each: 3*n_nodes x 3*nodes.size().
inline Eigen::MatrixXd unit_forces(std::span<const int> nodes, Eigen::Index n_nodes) {
    Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(3 * n_nodes, 3 * std::ssize(nodes));
    for (std::size_t i = 0; i < nodes.size(); ++i)
        forces.block<3, 3>(3 * nodes[i], 3 * static_cast<Eigen::Index>(i)).setIdentity();
    return forces;
}

/// The node that moves most, and how far; u: 3*n_nodes.
inline double largest_motion(const Eigen::VectorXd& u, Eigen::Index& node) {
    return u.size() == 0
               ? 0.0
               : Eigen::Map<const Eigen::Matrix3Xd>(u.data(), 3, u.size() / 3).colwise().norm().maxCoeff(&node);
}

}  // namespace elastolab
