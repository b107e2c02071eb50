#include "bem/hierarchical/cluster_tree.hpp"

#include <algorithm>
#include <numeric>

#include "deform/node_rows.hpp"

namespace elastolab {

ClusterTree::ClusterTree(std::span<const Eigen::AlignedBox3d> boxes, int leaf_size)
    : order_(boxes.size()), positions_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    clusters_.push_back({{0, size()}, {}, -1});
    for (int c = 0; c < static_cast<int>(clusters_.size()); ++c) cut(c, boxes, leaf_size);
    for (int position = 0; position < size(); ++position)
        positions_[static_cast<std::size_t>(order_[static_cast<std::size_t>(position)])] = position;
    for (int c = 0; c < static_cast<int>(clusters_.size()); ++c)
        if (cluster(c).is_leaf()) leaves_.push_back(c);
    std::sort(leaves_.begin(), leaves_.end(),
              [&](int a, int b) { return cluster(a).range.begin < cluster(b).range.begin; });
}

void ClusterTree::cut(int c, std::span<const Eigen::AlignedBox3d> boxes, int leaf_size) {
    const PositionRange range = cluster(c).range;
    Eigen::AlignedBox3d box, centres;
    for (int position = range.begin; position < range.end; ++position) {
        const auto& item = boxes[static_cast<std::size_t>(order_[static_cast<std::size_t>(position)])];
        box.extend(item);
        centres.extend(item.center());
    }
    clusters_[static_cast<std::size_t>(c)].box = box;
    if (range.size() <= leaf_size) return;
    Eigen::Index axis = 0;
    centres.sizes().maxCoeff(&axis);
    const auto coordinate = [&](int item) { return boxes[static_cast<std::size_t>(item)].center()[axis]; };
    std::sort(order_.begin() + range.begin, order_.begin() + range.end, [&](int a, int b) {
        const double x = coordinate(a), y = coordinate(b);
        return x < y || (x == y && a < b);
    });
    const int middle = range.begin + range.size() / 2;
    clusters_[static_cast<std::size_t>(c)].first_child = static_cast<int>(clusters_.size());
    clusters_.push_back({{range.begin, middle}, {}, -1});
    clusters_.push_back({{middle, range.end}, {}, -1});
}

std::vector<PositionRange> clusters_up_to(const ClusterTree& tree, int n) {
    std::vector<PositionRange> ranges;
    std::vector<int> waiting = {0};
    while (!waiting.empty()) {
        const ClusterTree::Cluster& cluster = tree.cluster(waiting.back());
        waiting.pop_back();
        if (cluster.is_leaf() || cluster.range.size() <= n) {
            if (cluster.range.size() > 0) ranges.push_back(cluster.range);
        } else {
            waiting.push_back(cluster.first_child + 1);
            waiting.push_back(cluster.first_child);
        }
    }
    return ranges;
}

Eigen::MatrixXd to_tree_order(const ClusterTree& tree, const Eigen::MatrixXd& by_item) {
    return rows_of(by_item, tree.order());
}

Eigen::MatrixXd to_item_order(const ClusterTree& tree, const Eigen::MatrixXd& by_position) {
    Eigen::MatrixXd by_item(by_position.rows(), by_position.cols());
    put_rows(by_position, tree.order(), by_item);
    return by_item;
}

SparseColumns to_tree_order(const ClusterTree& tree, const SparseColumns& by_item) {
    SparseColumns by_position(by_item.rows(), by_item.cols());
    by_position.reserve(by_item.nonZeros());
    for (int position = 0; position < tree.size(); ++position)
        for (int k = 0; k < 3; ++k) {
            by_position.startVec(3 * position + k);
            const int row = 3 * tree.order()[static_cast<std::size_t>(position)] + k;
            for (SparseColumns::InnerIterator entry(by_item, row); entry; ++entry)
                by_position.insertBackByOuterInner(3 * position + k, entry.index()) = entry.value();
        }
    by_position.finalize();
    return by_position;
}

namespace {

class Cover {
public:
    Cover(const ClusterTree& rows, const ClusterTree& cols, double eta) : rows_(rows), cols_(cols), eta_(eta) {}

    void add(int row, int col) {
        const ClusterTree::Cluster &r = rows_.cluster(row), &c = cols_.cluster(col);
        const double smaller = std::min(r.box.diagonal().norm(), c.box.diagonal().norm());
        if (smaller <= eta_ * r.box.exteriorDistance(c.box)) {
            pairs.push_back({row, col, true});
        } else if (r.is_leaf() && c.is_leaf()) {
            pairs.push_back({row, col, false});
        } else if (c.is_leaf() || (!r.is_leaf() && r.range.size() >= 2 * c.range.size())) {
            for (int i = 0; i < 2; ++i) add(r.first_child + i, col);
        } else if (r.is_leaf() || c.range.size() >= 2 * r.range.size()) {
            for (int j = 0; j < 2; ++j) add(row, c.first_child + j);
        } else {
            for (int i = 0; i < 2; ++i)
                for (int j = 0; j < 2; ++j) add(r.first_child + i, c.first_child + j);
        }
    }

    void add_symmetric(int cluster) {
        const ClusterTree::Cluster& c = rows_.cluster(cluster);
        if (c.is_leaf()) {
            pairs.push_back({cluster, cluster, false});
            return;
        }
        add_symmetric(c.first_child);
        add(c.first_child + 1, c.first_child);
        add_symmetric(c.first_child + 1);
    }

    std::vector<ClusterPair> pairs;

private:
    const ClusterTree &rows_, &cols_;
    double eta_;
};

}  // namespace

std::vector<ClusterPair> cover_matrix(const ClusterTree& rows, const ClusterTree& cols, double eta) {
    Cover cover(rows, cols, eta);
    if (rows.size() > 0 && cols.size() > 0) cover.add(0, 0);
    return std::move(cover.pairs);
}

std::vector<ClusterPair> cover_symmetric_matrix(const ClusterTree& tree, double eta) {
    Cover cover(tree, tree, eta);
    if (tree.size() > 0) cover.add_symmetric(0);
    return std::move(cover.pairs);
}

}  // namespace elastolab
