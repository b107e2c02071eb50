#pragma once

#include <Eigen/Core>
#include <vector>

#include "bem/hierarchical/cluster_tree.hpp"

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

/// Columns with the rows, three an item, of some items among n_items: zero at the others.
inline SparseColumns spread_over(const SparseColumns& X, const std::vector<int>& items, int n_items) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int row = 0; row < X.rows(); ++row)
        for (SparseColumns::InnerIterator entry(X, row); entry; ++entry)
            entries.emplace_back(3 * items[static_cast<std::size_t>(row / 3)] + row % 3,
                                 static_cast<int>(entry.index()), entry.value());
    SparseColumns all(3 * n_items, X.cols());
    all.setFromTriplets(entries.begin(), entries.end());
    return all;
}

}  // namespace elastolab
