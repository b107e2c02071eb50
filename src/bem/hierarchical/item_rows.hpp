#pragma once

#include <Eigen/Core>
#include <vector>

#include "bem/hierarchical/cluster_tree.hpp"
#include "deform/node_rows.hpp"

namespace elastolab {

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
