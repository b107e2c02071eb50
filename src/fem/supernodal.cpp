#include "fem/supernodal.hpp"

#include <lapacke.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <Eigen/Core>
#include <numeric>
#include <vector>

#include "base/blas.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"

namespace elastolab {

namespace {

using Block = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

/// Columns of a block product at once: a fraction of a second for the largest bodies, between two checks for a cancel.
constexpr int kPanel = 192;
/// Rows that a thread solves for at once.
constexpr int kRows = 256;

/// The update of a supernode by an earlier one, `from`, whose rows from `first_row` on are rows of this one.
struct BlockUpdate {
    int from, first_row;
};

/// Buffers of a thread for updates.
struct Scratch {
    std::vector<int> local;
    Eigen::MatrixXd product;
};

/// What it takes to eliminate one supernode after the other.
struct Workspace {
    std::vector<int> place;  ///< of a row of the factor among those of the supernode
    Scratch scratch;
};

/// How the parts of a supernode that do not depend on each other are eliminated.
enum class Share {
    alone,   ///< one after the other: other threads have supernodes of their own
    threads  ///< by all threads
};

/// Columns of a supernode that are taken at once, of so many.
int columns_at_once(int n, Share share) { return share == Share::alone ? kPanel : std::clamp(n / 8, 32, kPanel); }

class Factorisation {
public:
    Factorisation(const SupernodalView& pattern, double* values, const std::string& name, Control& control);
    void run(const SparseMatrix& A);

private:
    static std::size_t at(int i) { return static_cast<std::size_t>(i); }
    int first_column(int s) const { return L_.super[at(s)]; }
    int n_columns(int s) const { return L_.super[at(s) + 1] - L_.super[at(s)]; }
    int n_rows(int s) const { return L_.first_row[at(s) + 1] - L_.first_row[at(s)]; }
    std::span<const int> rows(int s) const { return L_.rows.subspan(at(L_.first_row[at(s)]), at(n_rows(s))); }
    /// Columns [column, column + count) of a supernode from a row on.
    Block block(int s, int row, int column, int count) const {
        const int n = n_rows(s);
        double* begin = values_ + L_.first_value[at(s)] + row + static_cast<std::ptrdiff_t>(column) * n;
        return {begin, n - row, count, Eigen::OuterStride<>(n)};
    }
    double work(int s) const {
        const double columns = n_columns(s), rows = n_rows(s);
        return columns * rows * rows;
    }

    void find_updates();
    /// Maximal subtrees that are a small part of the whole, as ranges of supernodes, the largest first; and the rest.
    void find_parts();
    void scatter(const SparseMatrix& A);
    void eliminate(int s, Workspace& workspace, Share share);
    /// What the updates subtract from columns [begin, end) of a supernode. place: of its rows
    void take_over(const BlockUpdate& update, int s, int begin, int end, const std::vector<int>& place,
                   Scratch& scratch);
    void factorise_own(int s, Share share);
    /// Calls use(begin, end) for blocks of [0, n).
    template <class Use>
    void for_blocks(int n, int at_once, Share share, const Use& use) {
        if (share == Share::threads) {
            Control inner;  // progress is that of the whole
            parallel_blocks(n, at_once, inner, use);
            return;
        }
        for (int begin = 0; begin < n; begin += at_once) use(begin, std::min(n, begin + at_once));
    }
    void report(int s) { control_.set_progress((done_ += work(s)) / total_work_); }

    struct Part {
        int begin, end;
        double work;
    };

    SupernodalView L_;
    double* values_;
    const std::string& name_;
    Control& control_;
    std::vector<int> supernode_;             ///< of a row
    std::vector<BlockUpdate> updates_;       ///< of all supernodes
    std::vector<std::size_t> first_update_;  ///< of each
    std::vector<Part> parts_;
    std::vector<int> top_;
    double total_work_ = 0.0;
    std::atomic<double> done_{0.0};
};

Factorisation::Factorisation(const SupernodalView& pattern, double* values, const std::string& name, Control& control)
    : L_(pattern), values_(values), name_(name), control_(control), supernode_(pattern.permutation.size()) {
    for (int s = 0; s < L_.n_supernodes(); ++s) {
        std::fill_n(supernode_.begin() + first_column(s), n_columns(s), s);
        total_work_ += work(s);
    }
    find_updates();
    find_parts();
}

void Factorisation::find_updates() {
    const auto for_each_target = [&](const auto& use) {
        for (int s = 0; s < L_.n_supernodes(); ++s)
            for (int row = n_columns(s), n = n_rows(s); row < n;) {
                const int target = supernode_[at(rows(s)[at(row)])];
                use(target, BlockUpdate{s, row});
                while (row < n && supernode_[at(rows(s)[at(row)])] == target) ++row;
            }
    };
    first_update_.assign(at(L_.n_supernodes()) + 1, 0);
    for_each_target([&](int target, const BlockUpdate&) { ++first_update_[at(target) + 1]; });
    std::partial_sum(first_update_.begin(), first_update_.end(), first_update_.begin());
    updates_.resize(first_update_.back());
    std::vector<std::size_t> next(first_update_.begin(), first_update_.end() - 1);
    for_each_target([&](int target, const BlockUpdate& update) { updates_[next[at(target)]++] = update; });
}

void Factorisation::find_parts() {
    constexpr double kSmall = 1.0 / 24.0;
    const int n = L_.n_supernodes();
    // Supernodes are in postorder: a subtree is a range that ends with its root.
    std::vector<int> parent(at(n), n), begin(at(n));
    std::iota(begin.begin(), begin.end(), 0);
    std::vector<double> subtree(at(n), 0.0);
    for (int s = 0; s < n; ++s) {
        subtree[at(s)] += work(s);
        if (n_rows(s) == n_columns(s)) continue;
        const int p = parent[at(s)] = supernode_[at(rows(s)[at(n_columns(s))])];
        assert(p > s);
        begin[at(p)] = std::min(begin[at(p)], begin[at(s)]);
        subtree[at(p)] += subtree[at(s)];
    }
    const auto is_small = [&](int s) { return s < n && subtree[at(s)] <= kSmall * total_work_; };
    for (int s = 0; s < n; ++s)
        if (!is_small(s)) {
            top_.push_back(s);
        } else if (!is_small(parent[at(s)])) {
            parts_.push_back({begin[at(s)], s + 1, subtree[at(s)]});
        }
    std::stable_sort(parts_.begin(), parts_.end(), [](const Part& a, const Part& b) { return a.work > b.work; });
}

void Factorisation::scatter(const SparseMatrix& A) {
    std::vector<int> place(L_.permutation.size());
    for (std::size_t i = 0; i < place.size(); ++i) place[at(L_.permutation[i])] = static_cast<int>(i);
    constexpr int kSupernodes = 256, kColumns = 4096;
    Control inner;  // these are not the steps to report
    parallel_blocks(L_.n_supernodes(), kSupernodes, inner, [&](int begin, int end) {
        std::fill(values_ + L_.first_value[at(begin)], values_ + L_.first_value[at(end)], 0.0);
    });
    control_.checkpoint();
    parallel_blocks(static_cast<int>(A.cols()), kColumns, inner, [&](int begin, int end) {
        for (int j = begin; j < end; ++j) {
            int last = -1;
            std::size_t found = 0;
            for (SparseMatrix::InnerIterator it(A, j); it; ++it) {
                if (it.row() < j) continue;
                const auto [column, row] = std::minmax(place[at(j)], place[static_cast<std::size_t>(it.row())]);
                const int s = supernode_[at(column)];
                const std::span<const int> rows_of_s = rows(s);
                // The rows of a node mostly follow each other.
                if (++found; s != last || found >= rows_of_s.size() || rows_of_s[found] != row)
                    found = static_cast<std::size_t>(std::lower_bound(rows_of_s.begin(), rows_of_s.end(), row) -
                                                     rows_of_s.begin());
                last = s;
                values_[L_.first_value[at(s)] + static_cast<std::ptrdiff_t>(column - first_column(s)) * n_rows(s) +
                        static_cast<std::ptrdiff_t>(found)] = it.value();
            }
        }
    });
    control_.checkpoint();
}

void Factorisation::take_over(const BlockUpdate& update, int s, int begin, int end, const std::vector<int>& place,
                              Scratch& scratch) {
    const auto [from, first] = update;
    const std::span<const int> all = rows(from).subspan(at(first));
    const auto of_column = [&](int column) {
        return static_cast<int>(std::lower_bound(all.begin(), all.end(), first_column(s) + column) - all.begin());
    };
    const int skipped = of_column(begin), count = of_column(end) - skipped;
    if (count == 0) return;
    control_.checkpoint();
    const std::span<const int> theirs = all.subspan(at(skipped));
    const auto n = static_cast<int>(theirs.size());
    scratch.local.resize(theirs.size());
    for (std::size_t i = 0; i < theirs.size(); ++i) scratch.local[i] = place[at(theirs[i])];
    const Block source = block(from, first + skipped, 0, n_columns(from));
    scratch.product.resize(n, count);
    scratch.product.noalias() = source * source.topRows(count).transpose();
    for (int j = 0; j < count; ++j) {
        const double* products = scratch.product.col(j).data();
        double* target = block(s, 0, theirs[at(j)] - first_column(s), 1).data();
        for (int i = j; i < n; ++i) target[scratch.local[at(i)]] -= products[i];
    }
}

void Factorisation::factorise_own(int s, Share share) {
    const int n = n_columns(s);
    for (int begin = 0; begin < n; begin += kPanel) {
        control_.checkpoint();
        const int count = std::min(kPanel, n - begin);
        Block panel = block(s, begin, begin, count);
        if (LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'L', count, panel.data(), n_rows(s)) != 0)
            throw NotPositiveDefiniteError(name_ +
                                           ": is not positive definite. Check the mesh for degenerate tetrahedra.");
        const auto n_below = static_cast<int>(panel.rows()) - count;
        for_blocks(n_below, kRows, share, [&](int first, int last) {
            auto below = panel.middleRows(count + first, last - first);
            panel.topRows(count).triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(below);
        });
        const int next = begin + count;
        for_blocks(n - next, columns_at_once(n - next, share), share, [&](int first, int last) {
            control_.checkpoint();
            const auto from_next = panel.bottomRows(n_rows(s) - next - first);
            block(s, next + first, next + first, last - first).noalias() -=
                from_next * from_next.topRows(last - first).transpose();
        });
    }
}

void Factorisation::eliminate(int s, Workspace& workspace, Share share) {
    control_.checkpoint();
    if (workspace.place.empty()) workspace.place.resize(L_.permutation.size());
    const std::span<const int> own = rows(s);
    for (std::size_t i = 0; i < own.size(); ++i) workspace.place[at(own[i])] = static_cast<int>(i);
    const auto take_over_all = [&](int begin, int end, Scratch& scratch) {
        for (std::size_t u = first_update_[at(s)]; u < first_update_[at(s) + 1]; ++u)
            take_over(updates_[u], s, begin, end, workspace.place, scratch);
    };
    const int n = n_columns(s);
    for_blocks(n, columns_at_once(n, share), share, [&](int begin, int end) {
        if (share == Share::alone) return take_over_all(begin, end, workspace.scratch);
        Scratch of_thread;
        take_over_all(begin, end, of_thread);
    });
    factorise_own(s, share);
    report(s);
}

void Factorisation::run(const SparseMatrix& A) {
    scatter(A);
    const SerialBlas serial;
    Control inner;  // progress is that of the whole
    parallel_blocks(static_cast<int>(parts_.size()), 1, inner, [&](int begin, int) {
        Workspace workspace;
        for (int s = parts_[at(begin)].begin; s < parts_[at(begin)].end; ++s) eliminate(s, workspace, Share::alone);
    });
    Workspace workspace;
    for (const int s : top_) eliminate(s, workspace, Share::threads);
}

}  // namespace

void factorise_supernodes(const SupernodalView& pattern, const SparseMatrix& A, double* values, const std::string& name,
                          Control& control) {
    Factorisation(pattern, values, name, control).run(A);
}

}  // namespace elastolab
