#include "bem/hierarchical/hierarchical_matrix.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <Eigen/SparseCore>
#include <utility>

#include "base/blas.hpp"
#include "base/mixed_product.hpp"
#include "base/parallel.hpp"

namespace elastolab {

namespace {

/// Tolerance of far blocks below which single precision, 6e-8, is too little.
constexpr double kLeastSingle = 1e-7;

/// Of ascending numbers, those in a range: [first, last).
std::pair<Eigen::Index, Eigen::Index> within(const std::vector<int>& positions, PositionRange range) {
    const auto first = std::lower_bound(positions.begin(), positions.end(), range.begin);
    const auto last = std::lower_bound(first, positions.end(), range.end);
    return {first - positions.begin(), last - positions.begin()};
}

/// Rows, three a position, of some positions in a block that begins at `begin`.
std::vector<Eigen::Index> scalar_rows(const std::vector<int>& positions, Eigen::Index first, Eigen::Index last,
                                      int begin) {
    std::vector<Eigen::Index> rows;
    for (Eigen::Index i = first; i < last; ++i)
        for (int k = 0; k < 3; ++k) rows.push_back(3 * (positions[static_cast<std::size_t>(i)] - begin) + k);
    return rows;
}

/// Rows and columns up to which all entries of a far block are computed, many at once, rather than some one by one.
constexpr int kSmallBlock = 128;

/// A block that is in memory.
class StoredEntries : public BlockEntries {
public:
    StoredEntries(const BlockEntries& entries, PositionRange rows, PositionRange cols)
        : rows_(rows), cols_(cols), block_(3 * rows.size(), 3 * cols.size()) {
        entries.fill_far(rows, cols, block_);
    }
    void fill(PositionRange rows, PositionRange cols, Eigen::Ref<Eigen::MatrixXd> out) const override {
        out = block_.block(3 * (rows.begin - rows_.begin), 3 * (cols.begin - cols_.begin), out.rows(), out.cols());
    }
    bool are_stored() const override { return true; }

private:
    PositionRange rows_, cols_;
    Eigen::MatrixXd block_;
};

LowRankMatrix approximate(const BlockEntries& entries, PositionRange rows, PositionRange cols, double tolerance) {
    if (std::max(rows.size(), cols.size()) > kSmallBlock) return cross_approximation(entries, rows, cols, tolerance);
    return cross_approximation(StoredEntries(entries, rows, cols), rows, cols, tolerance);
}

}  // namespace

/// A factor of a far block, in single precision where that keeps the tolerance.
class FarFactor {
public:
    FarFactor() = default;
    FarFactor(Eigen::MatrixXd A, double tolerance) {
        if (tolerance < kLeastSingle)
            exact_ = std::move(A);
        else
            single_ = A.cast<float>();
    }
    std::uint64_t memory_bytes() const {
        return 4 * static_cast<std::uint64_t>(single_.size()) + 8 * static_cast<std::uint64_t>(exact_.size());
    }
    /// Y += A X
    void add_product(const Eigen::Ref<const Eigen::MatrixXd>& X, Eigen::Ref<Eigen::MatrixXd> Y) const {
        if (exact_.size() > 0)
            Y.noalias() += exact_ * X;
        else
            add_mixed_product(single_, X, Y);
    }
    /// A^T X
    Eigen::MatrixXd transposed_product(const Eigen::Ref<const Eigen::MatrixXd>& X) const {
        if (exact_.size() > 0) return exact_.transpose() * X;
        return transposed_mixed_product(single_, X);
    }
    Eigen::MatrixXd rows(const std::vector<Eigen::Index>& numbers) const {
        if (exact_.size() > 0) return exact_(numbers, Eigen::all);
        return single_(numbers, Eigen::all).cast<double>();
    }
    Eigen::MatrixXd rows(Eigen::Index first, Eigen::Index n) const {
        if (exact_.size() > 0) return exact_.middleRows(first, n);
        return single_.middleRows(first, n).cast<double>();
    }
    Eigen::MatrixXd all() const { return exact_.size() > 0 ? exact_ : Eigen::MatrixXd(single_.cast<double>()); }

private:
    Eigen::MatrixXf single_;
    Eigen::MatrixXd exact_;  ///< or empty
};

struct HierarchicalMatrix::Block {
    PositionRange rows, cols;
    bool mirrored = false;  ///< of a symmetric matrix, off its diagonal: stands for its transpose too
    Eigen::MatrixXd near;   ///< all entries, or empty
    FarFactor U, V;

    bool is_near() const { return near.size() > 0; }
    /// Y += the block, or its transpose, times X, in the rows concerned.
    void add_product(const Eigen::MatrixXd& X, Eigen::MatrixXd& Y) const {
        const auto x = X.middleRows(3 * cols.begin, 3 * cols.size());
        auto y = Y.middleRows(3 * rows.begin, 3 * rows.size());
        if (is_near())
            y.noalias() += near * x;
        else
            U.add_product(V.transposed_product(x), y);
    }
    void add_transposed_product(const Eigen::MatrixXd& X, Eigen::MatrixXd& Y) const {
        const auto x = X.middleRows(3 * rows.begin, 3 * rows.size());
        auto y = Y.middleRows(3 * cols.begin, 3 * cols.size());
        if (is_near())
            y.noalias() += near.transpose() * x;
        else
            V.add_product(U.transposed_product(x), y);
    }
};

/// A block, or its transpose, as a part of the rows of one leaf.
struct HierarchicalMatrix::Side {
    int block = 0;
    bool transposed = false;
};

HierarchicalMatrix::~HierarchicalMatrix() = default;

HierarchicalMatrix::HierarchicalMatrix(std::shared_ptr<const ClusterTree> rows, std::shared_ptr<const ClusterTree> cols,
                                       bool symmetric, const BlockEntries& entries, const HierarchicalOptions& options,
                                       Control& control)
    : row_tree_(std::move(rows)), col_tree_(std::move(cols)), symmetric_(symmetric) {
    std::vector<ClusterPair> pairs =
        symmetric ? cover_symmetric_matrix(*row_tree_, options.eta) : cover_matrix(*row_tree_, *col_tree_, options.eta);
    const auto size = [&](const ClusterPair& pair) {
        return row_tree_->cluster(pair.row).range.size() + col_tree_->cluster(pair.col).range.size();
    };
    // The largest first, so that no thread is left with one of them at the end.
    std::stable_sort(pairs.begin(), pairs.end(),
                     [&](const ClusterPair& a, const ClusterPair& b) { return size(a) > size(b); });
    blocks_.resize(pairs.size());
    const SerialBlas serial;
    parallel_blocks(static_cast<int>(pairs.size()), 1, control, [&](int b, int) {
        const ClusterPair& pair = pairs[static_cast<std::size_t>(b)];
        Block& block = blocks_[static_cast<std::size_t>(b)];
        block.rows = row_tree_->cluster(pair.row).range;
        block.cols = col_tree_->cluster(pair.col).range;
        block.mirrored = symmetric_ && pair.row != pair.col;
        if (pair.admissible) {
            const LowRankMatrix cross = approximate(entries, block.rows, block.cols, 0.5 * options.tolerance);
            LowRankMatrix least = recompressed(cross, 0.5 * options.tolerance);
            block.U = FarFactor(std::move(least.U), options.tolerance);
            block.V = FarFactor(std::move(least.V), options.tolerance);
        } else {
            block.near.resize(3 * block.rows.size(), 3 * block.cols.size());
            entries.fill(block.rows, block.cols, block.near);
            if (symmetric_ && pair.row == pair.col) block.near = (0.5 * (block.near + block.near.transpose())).eval();
        }
    });
    list_sides();
}

void HierarchicalMatrix::list_sides() {
    const auto& leaves = row_tree_->leaves();
    row_sides_.resize(leaves.size());
    const auto list = [&](PositionRange range, Side side) {
        const auto first = std::partition_point(
            leaves.begin(), leaves.end(), [&](int leaf) { return row_tree_->cluster(leaf).range.end <= range.begin; });
        for (auto leaf = first; leaf != leaves.end() && row_tree_->cluster(*leaf).range.begin < range.end; ++leaf)
            row_sides_[static_cast<std::size_t>(leaf - leaves.begin())].push_back(side);
    };
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        const Block& block = blocks_[b];
        list(block.rows, {static_cast<int>(b), false});
        if (block.mirrored) list(block.cols, {static_cast<int>(b), true});
    }
}

Eigen::MatrixXd HierarchicalMatrix::product(const Eigen::MatrixXd& X) const { return multiply(X, false); }

Eigen::MatrixXd HierarchicalMatrix::transposed_product(const Eigen::MatrixXd& X) const {
    return multiply(X, !symmetric_);
}

/// Each block is read from memory once, for both of its sides. The blocks add up in groups that are the same for any
/// number of threads, and so is the result.
Eigen::MatrixXd HierarchicalMatrix::multiply(const Eigen::MatrixXd& X, bool transposed) const {
    constexpr std::size_t kGroups = 16;
    constexpr Eigen::Index kMostColumns = 16;  // each group has sums of its own
    if (X.cols() > kMostColumns) {
        Eigen::MatrixXd Y(3 * (transposed ? *col_tree_ : *row_tree_).size(), X.cols());
        for (Eigen::Index first = 0; first < X.cols(); first += kMostColumns) {
            const Eigen::Index n = std::min(kMostColumns, X.cols() - first);
            Y.middleCols(first, n) = multiply(X.middleCols(first, n), transposed);
        }
        return Y;
    }
    const Eigen::Index n_rows = 3 * (transposed ? *col_tree_ : *row_tree_).size();
    std::vector<Eigen::MatrixXd> sums(kGroups);
    Control control;
    const SerialBlas serial;
    parallel_blocks(kGroups, 1, control, [&](int group, int) {
        Eigen::MatrixXd& Y = sums[static_cast<std::size_t>(group)];
        Y.setZero(n_rows, X.cols());
        for (std::size_t b = static_cast<std::size_t>(group); b < blocks_.size(); b += kGroups) {
            if (!transposed) blocks_[b].add_product(X, Y);
            if (transposed || blocks_[b].mirrored) blocks_[b].add_transposed_product(X, Y);
        }
    });
    for (std::size_t group = 1; group < kGroups; ++group) sums[0] += sums[group];
    return std::move(sums[0]);
}

Eigen::MatrixXd HierarchicalMatrix::submatrix(const std::vector<int>& row_positions,
                                              const std::vector<int>& col_positions) const {
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(3 * std::ssize(row_positions), 3 * std::ssize(col_positions));
    const auto& leaves = row_tree_->leaves();
    for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf) {
        const PositionRange range = row_tree_->cluster(leaves[leaf]).range;
        const auto [first_row, last_row] = within(row_positions, range);
        if (first_row == last_row) continue;
        for (const Side& side : row_sides_[leaf]) {
            const Block& block = blocks_[static_cast<std::size_t>(side.block)];
            const PositionRange own = side.transposed ? block.cols : block.rows;
            const PositionRange other = side.transposed ? block.rows : block.cols;
            const auto [first_col, last_col] = within(col_positions, other);
            if (first_col == last_col) continue;
            const auto of_rows = scalar_rows(row_positions, first_row, last_row, own.begin);
            const auto of_cols = scalar_rows(col_positions, first_col, last_col, other.begin);
            auto part = A.block(3 * first_row, 3 * first_col, std::ssize(of_rows), std::ssize(of_cols));
            if (!block.is_near()) {
                const FarFactor &left = side.transposed ? block.V : block.U,
                                &right = side.transposed ? block.U : block.V;
                part.noalias() = left.rows(of_rows) * right.rows(of_cols).transpose();
            } else if (side.transposed) {
                part = block.near(of_cols, of_rows).transpose();
            } else {
                part = block.near(of_rows, of_cols);
            }
        }
    }
    return A;
}

namespace {

/// Columns that Z has in the rows of a range, ascending.
std::vector<int> columns_of(const SparseColumns& Z, PositionRange range) {
    std::vector<int> columns;
    for (int row = 3 * range.begin; row < 3 * range.end; ++row)
        for (SparseColumns::InnerIterator entry(Z, row); entry; ++entry)
            columns.push_back(static_cast<int>(entry.index()));
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    return columns;
}

/// Z^T A of a range: columns of Z x columns of A.
Eigen::MatrixXd project(const SparseColumns& Z, PositionRange range, const std::vector<int>& columns,
                        const Eigen::MatrixXd& A) {
    Eigen::MatrixXd product = Eigen::MatrixXd::Zero(std::ssize(columns), A.cols());
    for (int row = 0; row < 3 * range.size(); ++row)
        for (SparseColumns::InnerIterator entry(Z, 3 * range.begin + row); entry; ++entry) {
            const auto at = std::lower_bound(columns.begin(), columns.end(), entry.index());
            product.row(at - columns.begin()) += entry.value() * A.row(row);
        }
    return product;
}

/// The rows of a range, of these columns alone.
Eigen::MatrixXd compact(const SparseColumns& Z, PositionRange range, const std::vector<int>& columns) {
    Eigen::MatrixXd own = Eigen::MatrixXd::Zero(3 * range.size(), std::ssize(columns));
    for (int row = 0; row < 3 * range.size(); ++row)
        for (SparseColumns::InnerIterator entry(Z, 3 * range.begin + row); entry; ++entry) {
            const auto at = std::lower_bound(columns.begin(), columns.end(), entry.index());
            own(row, at - columns.begin()) = entry.value();
        }
    return own;
}

}  // namespace

/// First V^T Z of every far block, then the rows of each leaf: no two threads write the same ones.
Eigen::MatrixXd HierarchicalMatrix::sparse_product(const SparseColumns& Z, Control& control) const {
    assert(!symmetric_);
    struct Seen {
        std::vector<int> columns;
        Eigen::MatrixXd values;  ///< V^T Z of a far block
    };
    std::vector<Seen> seen(blocks_.size());
    const SerialBlas serial;
    parallel_blocks(static_cast<int>(blocks_.size()), 1, control, [&](int b, int) {
        const Block& block = blocks_[static_cast<std::size_t>(b)];
        Seen& own = seen[static_cast<std::size_t>(b)];
        own.columns = columns_of(Z, block.cols);
        if (!block.is_near()) own.values = block.V.transposed_product(compact(Z, block.cols, own.columns));
    });
    Eigen::MatrixXd Y = Eigen::MatrixXd::Zero(rows(), Z.cols());
    const auto& leaves = row_tree_->leaves();
    parallel_blocks(static_cast<int>(leaves.size()), 1, control, [&](int leaf, int) {
        const PositionRange range = row_tree_->cluster(leaves[static_cast<std::size_t>(leaf)]).range;
        Eigen::MatrixXd sum(3 * range.size(), Z.cols());
        sum.setZero();
        for (const Side& side : row_sides_[static_cast<std::size_t>(leaf)]) {
            const Block& block = blocks_[static_cast<std::size_t>(side.block)];
            const auto& [columns, values] = seen[static_cast<std::size_t>(side.block)];
            if (columns.empty()) continue;
            const Eigen::Index first = 3 * (range.begin - block.rows.begin);
            Eigen::MatrixXd own(sum.rows(), std::ssize(columns));
            if (block.is_near())
                own.noalias() = block.near.middleRows(first, sum.rows()) * compact(Z, block.cols, columns);
            else
                own.noalias() = block.U.rows(first, sum.rows()) * values;
            sum(Eigen::all, columns) += own;
        }
        Y.middleRows(3 * range.begin, sum.rows()) = sum;
    });
    return Y;
}

/// What each block gives is computed in parallel, some at a time, and added in the order of the blocks.
Eigen::MatrixXd HierarchicalMatrix::galerkin_product(const SparseColumns& Z, Control& control) const {
    struct Projected {
        std::vector<int> rows, cols;
        Eigen::MatrixXd values;
    };
    constexpr std::size_t kAtOnce = 256;
    Eigen::MatrixXd E = Eigen::MatrixXd::Zero(Z.cols(), Z.cols());
    const SerialBlas serial;
    for (std::size_t first = 0; first < blocks_.size(); first += kAtOnce) {
        std::vector<Projected> some(std::min(kAtOnce, blocks_.size() - first));
        parallel_blocks(static_cast<int>(some.size()), 1, control, [&](int i, int) {
            Projected& own = some[static_cast<std::size_t>(i)];
            const Block& block = blocks_[first + static_cast<std::size_t>(i)];
            own.rows = columns_of(Z, block.rows);
            own.cols = columns_of(Z, block.cols);
            if (block.is_near()) {
                const Eigen::MatrixXd half = project(Z, block.rows, own.rows, block.near).transpose();
                own.values = project(Z, block.cols, own.cols, half).transpose();
            } else {
                own.values = project(Z, block.rows, own.rows, block.U.all()) *
                             project(Z, block.cols, own.cols, block.V.all()).transpose();
            }
        });
        for (std::size_t i = 0; i < some.size(); ++i)
            for (std::size_t c = 0; c < some[i].cols.size(); ++c)
                for (std::size_t r = 0; r < some[i].rows.size(); ++r) {
                    const double value = some[i].values(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c));
                    E(some[i].rows[r], some[i].cols[c]) += value;
                    if (blocks_[first + i].mirrored) E(some[i].cols[c], some[i].rows[r]) += value;
                }
    }
    return E;
}

std::uint64_t HierarchicalMatrix::memory_bytes() const {
    std::uint64_t bytes = 0;
    for (const Block& block : blocks_)
        bytes += 8 * static_cast<std::uint64_t>(block.near.size()) + block.U.memory_bytes() + block.V.memory_bytes();
    return bytes;
}

}  // namespace elastolab
