#include "deform/columns.hpp"

#include <algorithm>
#include <cassert>

#include "base/cancellable_lock.hpp"
#include "base/strips.hpp"

namespace elastolab {

namespace {

constexpr Eigen::Index kRowsOfProduct = 512, kBlocksOfCopy = 64;

std::uint64_t bytes_of(const Columns::Block& block) { return 8 * static_cast<std::uint64_t>(block->size()); }

}  // namespace

Columns::Columns(std::vector<Block> blocks) : blocks_(std::move(blocks)) {
    for (const Block& block : blocks_) n_cols_ += block->cols();
}

Eigen::MatrixXd Columns::middle(Eigen::Index first, Eigen::Index count) const {
    assert(first + count <= n_cols_);
    Eigen::MatrixXd part(blocks_.empty() ? 0 : blocks_.front()->rows(), count);
    std::vector<Eigen::Index> begins;
    Eigen::Index next = 0;
    for (const Block& block : blocks_) {
        begins.push_back(next);
        next += block->cols();
    }
    for_strips(std::ssize(blocks_), kBlocksOfCopy, [&](Eigen::Index first_block, Eigen::Index n_blocks) {
        for (auto i = static_cast<std::size_t>(first_block); i < static_cast<std::size_t>(first_block + n_blocks);
             ++i) {
            const Eigen::Index begin = begins[i], from = std::max(first, begin),
                               to = std::min(first + count, begin + blocks_[i]->cols());
            if (from < to) part.middleCols(from - first, to - from) = blocks_[i]->middleCols(from - begin, to - from);
        }
    });
    return part;
}

Eigen::MatrixXd Columns::rows_of(std::span<const int> nodes, Eigen::Index first_extra_row) const {
    const Eigen::Index n_rows = 3 * std::ssize(nodes);
    const Eigen::Index n_extra = blocks_.empty() ? 0 : blocks_.front()->rows() - first_extra_row;
    Eigen::MatrixXd rows(n_rows + n_extra, n_cols_);
    Eigen::Index begin = 0;
    for (const Block& block : blocks_) {
        for (Eigen::Index c = 0; c < block->cols(); ++c) {
            for (std::size_t i = 0; i < nodes.size(); ++i)
                rows.block<3, 1>(3 * static_cast<Eigen::Index>(i), begin + c) = block->block<3, 1>(3 * nodes[i], c);
            rows.col(begin + c).tail(n_extra) = block->col(c).tail(n_extra);
        }
        begin += block->cols();
    }
    return rows;
}

void Columns::add_product(const Eigen::MatrixXd& coefficients, Eigen::Ref<Eigen::MatrixXd> result) const {
    assert(coefficients.rows() == n_cols_);
    // Thousands of products with three columns each: strips of rows, so that threads do not meet after every one.
    for_strips(result.rows(), kRowsOfProduct, [&](Eigen::Index first, Eigen::Index count) {
        Eigen::Index begin = 0;
        for (const Block& block : blocks_) {
            result.middleRows(first, count).noalias() +=
                block->middleRows(first, count) * coefficients.middleRows(begin, block->cols());
            begin += block->cols();
        }
    });
}

Columns ColumnCache::get(const std::vector<ColumnKey>& keys,
                         const std::function<std::uint64_t(const ColumnKey&)>& bytes,
                         const std::function<std::vector<Columns::Block>(const std::vector<ColumnKey>&)>& compute,
                         const Control& control) {
    const auto lock = lock_unless_cancelled(mutex_, control);
    ++clock_;
    std::vector<ColumnKey> missing;
    std::uint64_t incoming = 0;
    for (const ColumnKey& key : keys)
        if (const auto found = entries_.find(key); found != entries_.end()) {
            found->second.last_use = clock_;
        } else {
            missing.push_back(key);
            incoming += bytes(key);
        }
    make_room(incoming);
    if (!missing.empty()) {
        const std::vector<Columns::Block> blocks = compute(missing);
        for (std::size_t i = 0; i < missing.size(); ++i) entries_[missing[i]] = {blocks[i], clock_};
    }
    std::vector<Columns::Block> blocks;
    for (const ColumnKey& key : keys) blocks.push_back(entries_.at(key).block);
    return Columns(std::move(blocks));
}

void ColumnCache::drop_unused(const Control& control) {
    const auto lock = lock_unless_cancelled(mutex_, control);
    std::erase_if(entries_, [](const auto& entry) { return entry.second.block.use_count() == 1; });
}

void ColumnCache::make_room(std::uint64_t incoming) {
    std::uint64_t total = incoming;
    std::vector<std::map<ColumnKey, Entry>::iterator> unused;
    for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
        total += bytes_of(entry->second.block);
        if (entry->second.block.use_count() == 1 && entry->second.last_use < clock_) unused.push_back(entry);
    }
    std::sort(unused.begin(), unused.end(),
              [](const auto& a, const auto& b) { return a->second.last_use < b->second.last_use; });
    for (const auto& entry : unused) {
        if (total <= budget_bytes_) return;
        total -= bytes_of(entry->second.block);
        entries_.erase(entry);
    }
}

}  // namespace elastolab
