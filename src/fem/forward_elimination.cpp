#include "fem/forward_elimination.hpp"

#include <algorithm>
#include <Eigen/Core>
#include <iterator>
#include <vector>

namespace elastolab {

namespace {

std::vector<int> supernodes_of_rows(const SupernodalView& L) {
    std::vector<int> supernodes(L.permutation.size());
    for (int s = 0; s < L.n_supernodes(); ++s)
        std::fill(supernodes.begin() + L.super[static_cast<std::size_t>(s)],
                  supernodes.begin() + L.super[static_cast<std::size_t>(s) + 1], s);
    return supernodes;
}

/// Forward substitution Y = L^-1 P B by supernodes, which only touches the columns that are not zero.
class ForwardElimination {
public:
    ForwardElimination(const SparseCholesky& factor, const SparseMatrix& B)
        : L_(factor.view()), n_columns_(static_cast<int>(B.cols())), blocks_(size(L_.n_supernodes())) {
        number_rows();
        find_columns(B);
        scatter(B);
    }

    /// S -= Y^T Y (lower triangle), supernode by supernode.
    void subtract_from(Eigen::MatrixXd& S, Control& control);

private:
    /// The rows of Y that belong to one supernode, in the columns that are not zero there.
    struct Block {
        std::vector<int> columns;  // ascending
        Eigen::MatrixXd Y;
    };

    static std::size_t size(int n) { return static_cast<std::size_t>(n); }
    static int at(std::span<const int> values, int i) { return values[size(i)]; }
    int n_own(int s) const { return at(L_.super, s + 1) - at(L_.super, s); }
    int n_rows(int s) const { return at(L_.first_row, s + 1) - at(L_.first_row, s); }
    std::span<const int> rows_below(int s) const {
        return L_.rows.subspan(size(at(L_.first_row, s) + n_own(s)), size(n_rows(s) - n_own(s)));
    }

    void number_rows();
    void find_columns(const SparseMatrix& B);
    void scatter(const SparseMatrix& B);
    void eliminate(int s);
    void add_to(int t, const Block& from, const Eigen::MatrixXd& update, std::span<const int> rows, int first);

    SupernodalView L_;
    int n_columns_;
    std::vector<Block> blocks_;
    std::vector<int> supernode_of_row_, place_of_row_;  // place: of a degree of freedom in the order of L
};

void ForwardElimination::number_rows() {
    supernode_of_row_ = supernodes_of_rows(L_);
    place_of_row_.resize(L_.permutation.size());
    for (std::size_t i = 0; i < L_.permutation.size(); ++i)
        place_of_row_[size(L_.permutation[i])] = static_cast<int>(i);
}

void ForwardElimination::find_columns(const SparseMatrix& B) {
    for (int column = 0; column < B.cols(); ++column)
        for (SparseMatrix::InnerIterator it(B, column); it; ++it) {
            const int s = supernode_of_row_[size(place_of_row_[size(static_cast<int>(it.row()))])];
            std::vector<int>& columns = blocks_[size(s)].columns;
            if (columns.empty() || columns.back() != column) columns.push_back(column);
        }
    // What is not zero in a supernode is not zero in its parent, the supernode of its first row below.
    std::vector<int> merged;
    for (int s = 0; s < L_.n_supernodes(); ++s) {
        if (rows_below(s).empty()) continue;
        const std::vector<int>& mine = blocks_[size(s)].columns;
        std::vector<int>& parents = blocks_[size(supernode_of_row_[size(rows_below(s).front())])].columns;
        merged.clear();
        std::set_union(mine.begin(), mine.end(), parents.begin(), parents.end(), std::back_inserter(merged));
        parents.assign(merged.begin(), merged.end());
    }
    for (int s = 0; s < L_.n_supernodes(); ++s) {
        Block& block = blocks_[size(s)];
        block.Y.setZero(n_own(s), std::ssize(block.columns));
    }
}

void ForwardElimination::scatter(const SparseMatrix& B) {
    for (int column = 0; column < B.cols(); ++column)
        for (SparseMatrix::InnerIterator it(B, column); it; ++it) {
            const int row = place_of_row_[size(static_cast<int>(it.row()))];
            const int s = supernode_of_row_[size(row)];
            Block& block = blocks_[size(s)];
            const auto j = std::lower_bound(block.columns.begin(), block.columns.end(), column) - block.columns.begin();
            block.Y(row - at(L_.super, s), j) = it.value();
        }
}

/// Block t -= update, whose rows `rows[first...]` and columns are those of `from`.
void ForwardElimination::add_to(int t, const Block& from, const Eigen::MatrixXd& update, std::span<const int> rows,
                                int first) {
    Block& to = blocks_[size(t)];
    auto column = to.columns.begin();
    for (std::size_t j = 0; j < from.columns.size(); ++j) {
        column = std::lower_bound(column, to.columns.end(), from.columns[j]);
        double* target = to.Y.col(column - to.columns.begin()).data();
        const double* source = update.col(static_cast<Eigen::Index>(j)).data() + first;
        for (std::size_t i = 0; i < rows.size(); ++i) target[rows[i] - at(L_.super, t)] -= source[i];
    }
}

void ForwardElimination::eliminate(int s) {
    Block& block = blocks_[size(s)];
    if (block.columns.empty()) return;
    const Eigen::Map<const Eigen::MatrixXd> L(L_.values + at(L_.first_value, s), n_rows(s), n_own(s));
    L.topRows(n_own(s)).triangularView<Eigen::Lower>().solveInPlace(block.Y);
    const std::span<const int> below = rows_below(s);
    const Eigen::MatrixXd update = L.bottomRows(std::ssize(below)) * block.Y;
    for (std::size_t begin = 0, end = 0; begin < below.size(); begin = end) {
        const int t = supernode_of_row_[size(below[begin])];
        while (end < below.size() && below[end] < at(L_.super, t + 1)) ++end;
        add_to(t, block, update, below.subspan(begin, end - begin), static_cast<int>(begin));
    }
}

void ForwardElimination::subtract_from(Eigen::MatrixXd& S, Control& control) {
    for (int s = 0; s < L_.n_supernodes(); ++s) {
        control.checkpoint();
        control.set_progress(static_cast<double>(s) / L_.n_supernodes());
        eliminate(s);
        Block& block = blocks_[size(s)];
        const Eigen::Index n = std::ssize(block.columns);
        if (n == n_columns_) {
            S.selfadjointView<Eigen::Lower>().rankUpdate(block.Y.transpose(), -1.0);
        } else if (n > 0) {
            Eigen::MatrixXd product = Eigen::MatrixXd::Zero(n, n);
            product.selfadjointView<Eigen::Lower>().rankUpdate(block.Y.transpose());
            for (Eigen::Index j = 0; j < n; ++j)
                for (Eigen::Index i = j; i < n; ++i)
                    S(block.columns[size(static_cast<int>(i))], block.columns[size(static_cast<int>(j))]) -=
                        product(i, j);
        }
        block = Block{};
    }
}

/// How a supernode looks from outside.
struct SupernodeShape {
    double columns = 0.0, rows = 0.0;  ///< rows: with those of its own columns
    int parent = -1;                   ///< the supernode of its first row below; none for a root
};

std::vector<SupernodeShape> shapes_of(const SupernodalView& L) {
    const std::vector<int> supernodes = supernodes_of_rows(L);
    std::vector<SupernodeShape> shapes(static_cast<std::size_t>(L.n_supernodes()));
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        const int columns = L.super[s + 1] - L.super[s], rows = L.first_row[s + 1] - L.first_row[s];
        shapes[s] = {static_cast<double>(columns), static_cast<double>(rows)};
        if (rows > columns)
            shapes[s].parent =
                supernodes[static_cast<std::size_t>(L.rows[static_cast<std::size_t>(L.first_row[s] + columns)])];
    }
    return shapes;
}

}  // namespace

void subtract_compressed_inverse(const SparseCholesky& factor, const SparseMatrix& B, Eigen::MatrixXd& S,
                                 Control& control) {
    ForwardElimination(factor, B).subtract_from(S, control);
}

CompressedInverseCost compressed_inverse_cost(const SupernodalView& pattern, std::span<const int> nodes) {
    const std::vector<SupernodeShape> shapes = shapes_of(pattern);
    const std::vector<int> supernodes = supernodes_of_rows(pattern);
    std::vector<int> place(pattern.permutation.size());
    for (std::size_t i = 0; i < place.size(); ++i)
        place[static_cast<std::size_t>(pattern.permutation[i])] = static_cast<int>(i);
    std::vector<double> count(shapes.size(), 0.0);  // of columns that are not zero, by supernode
    for (const int node : nodes) {
        const int row = place[static_cast<std::size_t>(3 * node)];
        for (int s = supernodes[static_cast<std::size_t>(row)]; s >= 0; s = shapes[static_cast<std::size_t>(s)].parent)
            count[static_cast<std::size_t>(s)] += 3.0;
    }
    CompressedInverseCost cost;
    double entries = 0.0;
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        const auto& [columns, rows, parent] = shapes[s];
        cost.flops += count[s] * columns * (2.0 * rows - columns + count[s]);
        entries += count[s] * columns;
    }
    cost.bytes = static_cast<std::uint64_t>(8.0 * entries);
    return cost;
}

double factorisation_flops(const SupernodalView& pattern) {
    double flops = 0.0;
    for (const auto& [columns, rows, parent] : shapes_of(pattern))
        flops += columns * (rows * rows - rows * columns + columns * columns / 3.0);
    return flops;
}

}  // namespace elastolab
