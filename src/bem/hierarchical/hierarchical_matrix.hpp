#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "base/control.hpp"
#include "bem/hierarchical/cluster_tree.hpp"
#include "bem/hierarchical/low_rank.hpp"

namespace elastolab {

/// How a hierarchical matrix approximates.
struct HierarchicalOptions {
    double tolerance = 1e-7;  ///< of a far block, relative to its Frobenius norm
    double eta = 1.5;         ///< see cover_matrix
};

/// A matrix of 3 x 3 blocks in blocks of two cluster trees: dense where both clusters are near each other, of low rank
/// elsewhere (the far field, in single precision where its tolerance is above that of a float). Rows and columns of
/// every function below are in the order of the trees, not in that of the items. Immutable after construction; any
/// thread may use it.
class HierarchicalMatrix {
public:
    /// Without `symmetric` all entries are asked for; with it (both trees the same) those of the lower triangle.
    /// What comes out does not depend on the number of threads. Throws Cancelled.
    HierarchicalMatrix(std::shared_ptr<const ClusterTree> rows, std::shared_ptr<const ClusterTree> cols, bool symmetric,
                       const BlockEntries& entries, const HierarchicalOptions& options, Control& control);
    ~HierarchicalMatrix();

    Eigen::Index rows() const { return 3 * row_tree_->size(); }
    Eigen::Index cols() const { return 3 * col_tree_->size(); }
    const ClusterTree& row_tree() const { return *row_tree_; }

    /// A X and A^T X, for any number of columns at once.
    Eigen::MatrixXd product(const Eigen::MatrixXd& X) const;
    Eigen::MatrixXd transposed_product(const Eigen::MatrixXd& X) const;
    /// A Z for columns that are zero in most clusters: each block takes part in the columns that it sees. Not of
    /// symmetric matrices. Throws Cancelled.
    Eigen::MatrixXd sparse_product(const SparseColumns& Z, Control& control) const;

    /// Entries at these positions of rows and of columns, both ascending.
    Eigen::MatrixXd submatrix(const std::vector<int>& row_positions, const std::vector<int>& col_positions) const;
    /// Z^T A Z of a symmetric matrix; Z is sparse, with three rows for each position. Throws Cancelled.
    Eigen::MatrixXd galerkin_product(const SparseColumns& Z, Control& control) const;

    std::uint64_t memory_bytes() const;

private:
    struct Block;
    struct Side;  ///< a block as a part of some rows

    Eigen::MatrixXd multiply(const Eigen::MatrixXd& X, bool transposed) const;
    void list_sides();

    std::shared_ptr<const ClusterTree> row_tree_, col_tree_;
    bool symmetric_;
    std::vector<Block> blocks_;
    std::vector<std::vector<Side>> row_sides_;  ///< of each leaf, in the order of the blocks
};

}  // namespace elastolab
