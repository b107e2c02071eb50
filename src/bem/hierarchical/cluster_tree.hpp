#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/SparseCore>
#include <span>
#include <vector>

namespace elastolab {

/// Columns with entries in few rows, of which there are three for each item of a cluster tree.
using SparseColumns = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Consecutive positions in the order of a cluster tree.
struct PositionRange {
    int begin = 0, end = 0;
    int size() const { return end - begin; }
    bool contains(int position) const { return begin <= position && position < end; }
};

/// Items in space (vertices with the triangles around them, triangles), halved again and again: those of a cluster are
/// neighbours in space and consecutive in `order`. The same for the same items, whatever the machine.
class ClusterTree {
public:
    struct Cluster {
        PositionRange range;
        Eigen::AlignedBox3d box;  ///< around all its items [L]
        int first_child = -1;     ///< the second follows; -1: a leaf
        bool is_leaf() const { return first_child < 0; }
    };

    /// boxes: what each item takes in space. Clusters of more than leaf_size items are cut across their longest side,
    /// half of the items on each.
    ClusterTree(std::span<const Eigen::AlignedBox3d> boxes, int leaf_size);

    int size() const { return static_cast<int>(order_.size()); }
    const std::vector<Cluster>& clusters() const { return clusters_; }  ///< the first is the root
    const Cluster& cluster(int c) const { return clusters_[static_cast<std::size_t>(c)]; }
    /// Clusters without children, by position.
    const std::vector<int>& leaves() const { return leaves_; }
    const std::vector<int>& order() const { return order_; }          ///< item at each position
    const std::vector<int>& positions() const { return positions_; }  ///< position of each item

private:
    void cut(int c, std::span<const Eigen::AlignedBox3d> boxes, int leaf_size);

    std::vector<int> order_, positions_, leaves_;
    std::vector<Cluster> clusters_;
};

/// The largest clusters of at most n items (leaves may have more), by position: they cover the tree.
std::vector<PositionRange> clusters_up_to(const ClusterTree& tree, int n);

/// Rows, three an item, from the order of the items to that of the tree and back.
Eigen::MatrixXd to_tree_order(const ClusterTree& tree, const Eigen::MatrixXd& by_item);
Eigen::MatrixXd to_item_order(const ClusterTree& tree, const Eigen::MatrixXd& by_position);
SparseColumns to_tree_order(const ClusterTree& tree, const SparseColumns& by_item);

/// A pair of clusters, one of rows and one of columns.
struct ClusterPair {
    int row = 0, col = 0;
    bool admissible = false;  ///< far enough apart for its block to be of low rank
};

/// Pairs that cover the whole matrix, each entry once. A pair is admissible when the smaller of both boxes' diameters
/// is at most `eta` times their distance.
std::vector<ClusterPair> cover_matrix(const ClusterTree& rows, const ClusterTree& cols, double eta);
/// The same for a symmetric matrix: of two pairs that mirror each other only the one with the later rows.
std::vector<ClusterPair> cover_symmetric_matrix(const ClusterTree& tree, double eta);

}  // namespace elastolab
