#pragma once

#include <Eigen/Core>
#include <vector>

namespace elastolab {

/// The rows, three an item, of some items.
inline Eigen::MatrixXd rows_of(const Eigen::MatrixXd& all, const std::vector<int>& items) {
    Eigen::MatrixXd rows(3 * std::ssize(items), all.cols());
    for (std::size_t i = 0; i < items.size(); ++i)
        rows.middleRows<3>(3 * static_cast<Eigen::Index>(i)) = all.middleRows<3>(3 * items[i]);
    return rows;
}

/// And back: the first rows go to those items.
inline void put_rows(const Eigen::MatrixXd& rows, const std::vector<int>& items, Eigen::MatrixXd& all) {
    for (std::size_t i = 0; i < items.size(); ++i)
        all.middleRows<3>(3 * items[i]) = rows.middleRows<3>(3 * static_cast<Eigen::Index>(i));
}

}  // namespace elastolab
