#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "base/control.hpp"

namespace elastolab {

/// Identifies a block of response columns; made by the model, meaningful to it alone.
using ColumnKey = std::vector<int>;

/// A matrix held as blocks of columns that others may share.
class Columns {
public:
    using Block = std::shared_ptr<const Eigen::MatrixXd>;

    Columns() = default;
    explicit Columns(std::vector<Block> blocks);

    Eigen::Index cols() const { return n_cols_; }
    /// Copy of columns [first, first + count).
    Eigen::MatrixXd middle(Eigen::Index first, Eigen::Index count) const;
    /// The three rows of each node, in the order of `nodes`, then the rows from `first_extra_row` on.
    Eigen::MatrixXd rows_of(std::span<const int> nodes, Eigen::Index first_extra_row) const;
    /// result += (the upper rows of these columns, as many as result has) * coefficients.
    void add_product(const Eigen::MatrixXd& coefficients, Eigen::Ref<Eigen::MatrixXd> result) const;

private:
    std::vector<Block> blocks_;
    Eigen::Index n_cols_ = 0;
};

/// Keeps blocks of columns that were expensive to compute. Any thread may use it.
class ColumnCache {
public:
    explicit ColumnCache(std::uint64_t budget_bytes) : budget_bytes_(budget_bytes) {}

    /// The blocks for these keys; `compute` is called once with the keys that are missing (if any) and returns their
    /// blocks. `bytes` tells the size of a missing block: when all would exceed the budget, blocks that nobody else
    /// holds are dropped first, least recently used first. While another thread computes, this waits: throws Cancelled
    /// when `control` is cancelled meanwhile.
    Columns get(const std::vector<ColumnKey>& keys, const std::function<std::uint64_t(const ColumnKey&)>& bytes,
                const std::function<std::vector<Columns::Block>(const std::vector<ColumnKey>&)>& compute,
                const Control& control);

    /// Drops all blocks that nobody else holds. Waits as get() does.
    void drop_unused(const Control& control);

private:
    struct Entry {
        Columns::Block block;
        std::uint64_t last_use = 0;
    };
    /// Drops blocks that nobody holds and that were not asked for just now, until so many more bytes fit.
    void make_room(std::uint64_t incoming);

    std::mutex mutex_;
    std::uint64_t budget_bytes_;
    std::uint64_t clock_ = 0;
    std::map<ColumnKey, Entry> entries_;
};

}  // namespace elastolab
