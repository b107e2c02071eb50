#pragma once

#include <vector>

#include "bem/hierarchical/cluster_tree.hpp"

namespace elastolab {

/// What two clusters have to do with each other.
enum class Interaction {
    far,   ///< all of their pairs at once
    near,  ///< their pairs one by one
    split  ///< as their halves do
};

/// For each cluster of `fields` the clusters of `sources` that act on it: far ones on the whole cluster, near ones on
/// leaves alone. Every pair of items is in one of the lists.
struct InteractionLists {
    std::vector<std::vector<int>> near, far;

    /// judge(f, s): of two clusters by number; of two leaves that would be split, the pairs are near.
    template <class Judge>
    InteractionLists(const ClusterTree& fields, const ClusterTree& sources, const Judge& judge)
        : near(fields.clusters().size()), far(fields.clusters().size()) {
        struct Pair {
            int field, source;
        };
        for (std::vector<Pair> open = {{0, 0}}; !open.empty();) {
            const auto [f, s] = open.back();
            open.pop_back();
            const ClusterTree::Cluster &field = fields.cluster(f), &source = sources.cluster(s);
            const Interaction kind = judge(f, s);
            const bool is_near = kind == Interaction::near || (field.is_leaf() && source.is_leaf());
            if (kind == Interaction::far)
                far[static_cast<std::size_t>(f)].push_back(s);
            else if (is_near && field.is_leaf())
                near[static_cast<std::size_t>(f)].push_back(s);
            else if (!field.is_leaf() &&
                     (is_near || source.is_leaf() || field.box.diagonal().norm() >= source.box.diagonal().norm()))
                for (const int child : {field.first_child, field.first_child + 1}) open.push_back({child, s});
            else
                for (const int child : {source.first_child, source.first_child + 1}) open.push_back({f, child});
        }
    }
};

}  // namespace elastolab
