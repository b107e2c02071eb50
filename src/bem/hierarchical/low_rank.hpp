#pragma once

#include <Eigen/Core>

#include "bem/hierarchical/cluster_tree.hpp"

namespace elastolab {

/// A matrix of 3 x 3 blocks whose entries are computed when they are asked for: rows and columns in the orders of two
/// cluster trees. Any thread may ask.
class BlockEntries {
public:
    virtual ~BlockEntries() = default;
    /// 3 rows.size() x 3 cols.size(), overwritten.
    virtual void fill(PositionRange rows, PositionRange cols, Eigen::Ref<Eigen::MatrixXd> out) const = 0;
    /// The same, as exactly as a far block needs it.
    virtual void fill_far(PositionRange rows, PositionRange cols, Eigen::Ref<Eigen::MatrixXd> out) const {
        fill(rows, cols, out);
    }
    /// Whether entries are only copied: then all of them are looked at.
    virtual bool are_stored() const { return false; }
};

/// U V^T
struct LowRankMatrix {
    Eigen::MatrixXd U, V;
    Eigen::Index rank() const { return U.cols(); }
};

/// U V^T ~ the block of these rows and columns, with an error of about `tolerance` times the Frobenius norm of the
/// block, by adaptive cross approximation: rows and columns of one node at a time, chosen by partial pivoting, each
/// with its 3 x 3 pivot. Rows that were not visited are sampled before it ends (or all of them looked at), as a block
/// of several parts of the surface can hide one of them from the pivots. The rank grows to that of the block, if need
/// be. Source: M. Bebendorf, Numer. Math. 86 (2000); the pivots are blocks here.
LowRankMatrix cross_approximation(const BlockEntries& entries, PositionRange rows, PositionRange cols,
                                  double tolerance);

/// The same product with the least rank that keeps `tolerance` times its Frobenius norm; V gets orthonormal columns.
LowRankMatrix recompressed(const LowRankMatrix& A, double tolerance);

}  // namespace elastolab
