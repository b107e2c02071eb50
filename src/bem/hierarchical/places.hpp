#pragma once

#include <algorithm>
#include <Eigen/Core>
#include <span>
#include <utility>
#include <vector>

#include "bem/hierarchical/cluster_tree.hpp"

namespace elastolab {

/// Where some items stand in a tree, ascending, and at which of these each item is.
struct Places {
    std::vector<int> positions;
    std::vector<Eigen::Index> of_items;  ///< three rows each

    Places(const ClusterTree& tree, std::span<const int> items) : of_items(3 * items.size()) {
        std::vector<std::pair<int, int>> placed;
        for (std::size_t i = 0; i < items.size(); ++i)
            placed.emplace_back(tree.positions()[static_cast<std::size_t>(items[i])], static_cast<int>(i));
        std::sort(placed.begin(), placed.end());
        for (std::size_t p = 0; p < placed.size(); ++p) {
            positions.push_back(placed[p].first);
            for (std::size_t k = 0; k < 3; ++k)
                of_items[3 * static_cast<std::size_t>(placed[p].second) + k] = static_cast<Eigen::Index>(3 * p + k);
        }
    }
};

/// Of some numbers those in [begin, end): which of them they are (three rows each), and by how much above `begin`.
struct NumbersWithin {
    std::vector<Eigen::Index> places;
    std::vector<int> numbers;

    NumbersWithin(std::span<const int> all, int begin, int end) {
        for (std::size_t i = 0; i < all.size(); ++i)
            if (begin <= all[i] && all[i] < end) {
                for (int k = 0; k < 3; ++k) places.push_back(3 * static_cast<Eigen::Index>(i) + k);
                numbers.push_back(all[i] - begin);
            }
    }
};

}  // namespace elastolab
