#include "fem/nonlinear/free_tangent.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "base/error.hpp"
#include "base/parallel.hpp"

namespace elastolab {

FreeTangent::FreeTangent(std::shared_ptr<const FiniteElements> elements, std::span<const int> constrained,
                         Control& control)
    : elements_(std::move(elements)), place_(static_cast<std::size_t>(elements_->n_nodes()), 0) {
    for (const int node : constrained) place_[static_cast<std::size_t>(node)] = -1;
    for (int node = 0; node < elements_->n_nodes(); ++node)
        if (int& place = place_[static_cast<std::size_t>(node)]; place == 0) {
            place = static_cast<int>(free_.size());
            free_.push_back(node);
        }
    find_pattern();
    control.checkpoint();
    analysis_ = std::make_unique<const CholeskyAnalysis>(pattern_, 3, true);
    control.checkpoint();
}

void FreeTangent::find_pattern() {
    const int n = elements_->nodes_per_element(), n_free = static_cast<int>(free_.size());
    std::vector<int> first(1, 0), neighbours, of_node;
    for (const int node : free_) {
        of_node.clear();
        for (const auto& [element, local] : elements_->around(node))
            for (int a = 0; a < n; ++a)
                if (const int place = place_[static_cast<std::size_t>(elements_->elements()(a, element))];
                    place >= place_[static_cast<std::size_t>(node)])
                    of_node.push_back(place);
        std::sort(of_node.begin(), of_node.end());
        of_node.erase(std::unique(of_node.begin(), of_node.end()), of_node.end());
        neighbours.insert(neighbours.end(), of_node.begin(), of_node.end());
        first.push_back(static_cast<int>(neighbours.size()));
    }
    if (9 * static_cast<std::int64_t>(neighbours.size()) > std::numeric_limits<int>::max())
        throw SolveError("tangent stiffness: more than 2^31 entries. Use a coarser mesh.");
    node_pattern_.resize(n_free, n_free);
    node_pattern_.resizeNonZeros(static_cast<Eigen::Index>(neighbours.size()));
    std::copy(first.begin(), first.end(), node_pattern_.outerIndexPtr());
    std::copy(neighbours.begin(), neighbours.end(), node_pattern_.innerIndexPtr());
    std::fill_n(node_pattern_.valuePtr(), neighbours.size(), 0.0);
    pattern_.resize(3 * n_free, 3 * n_free);
    pattern_.resizeNonZeros(9 * static_cast<Eigen::Index>(neighbours.size()));
    int entry = 0;
    for (int column = 0; column < 3 * n_free; ++column) {
        pattern_.outerIndexPtr()[column] = entry;
        for (int k = first[static_cast<std::size_t>(column / 3)]; k < first[static_cast<std::size_t>(column / 3) + 1];
             ++k)
            for (int i = 0; i < 3; ++i)
                pattern_.innerIndexPtr()[entry++] = 3 * neighbours[static_cast<std::size_t>(k)] + i;
    }
    pattern_.outerIndexPtr()[3 * n_free] = entry;
    std::fill_n(pattern_.valuePtr(), entry, 0.0);
    row_.assign(static_cast<std::size_t>(elements_->n_elements()) * static_cast<std::size_t>(n * n), -1);
    for (int e = 0; e < elements_->n_elements(); ++e)
        for (int b = 0; b < n; ++b)
            for (int a = 0; a < n; ++a) {
                const int column = place_[static_cast<std::size_t>(elements_->elements()(b, e))],
                          row = place_[static_cast<std::size_t>(elements_->elements()(a, e))];
                if (column < 0 || row < column) continue;
                const auto begin = neighbours.begin() + first[static_cast<std::size_t>(column)],
                           end = neighbours.begin() + first[static_cast<std::size_t>(column) + 1];
                row_[static_cast<std::size_t>((e * n + b) * n + a)] =
                    3 * static_cast<int>(std::lower_bound(begin, end, row) - begin);
            }
}

void FreeTangent::assemble(const ElementWork& work, double shift, SparseMatrix& K, Control& control) const {
    const int n = elements_->nodes_per_element(), numbers = 9 * block_count(n);
    const auto add_node = [&](int place) {
        const int first = K.outerIndexPtr()[3 * place], rows = K.outerIndexPtr()[3 * place + 1] - first;
        double* columns = K.valuePtr() + first;
        std::fill_n(columns, 3 * rows, 0.0);
        for (const auto& [element, b] : elements_->around(free_[static_cast<std::size_t>(place)])) {
            const double* blocks = work.stiffness.data() + static_cast<std::ptrdiff_t>(numbers) * element;
            for (int a = 0; a < n; ++a) {
                const int row = row_[static_cast<std::size_t>((element * n + b) * n + a)];
                if (row < 0) continue;
                // Column by column; the block of (b, a) is the transposed one.
                const double* block = blocks + 9 * (a >= b ? block_index(a, b) : block_index(b, a));
                const int down = a >= b ? 1 : 3, across = a >= b ? 3 : 1;
                for (int k = 0; k < 3; ++k)
                    for (int i = 0; i < 3; ++i) columns[k * rows + row + i] += block[across * k + down * i];
            }
        }
        for (int i = 0; i < 3; ++i) columns[i * rows + i] += shift;  // the node itself comes first
    };
    Control inner;
    parallel_blocks(static_cast<int>(free_.size()), 256, inner, [&](int begin, int end) {
        for (int place = begin; place < end; ++place) add_node(place);
    });
    control.checkpoint();
}

SparseMatrix FreeTangent::node_matrix(const std::function<double(int element, int a, int b)>& entry) const {
    const int n = elements_->nodes_per_element();
    SparseMatrix sum = node_pattern_;
    for (int e = 0; e < elements_->n_elements(); ++e)
        for (int b = 0; b < n; ++b)
            for (int a = 0; a < n; ++a)
                if (const int row = row_[static_cast<std::size_t>((e * n + b) * n + a)]; row >= 0)
                    sum.valuePtr()[sum.outerIndexPtr()[place_[static_cast<std::size_t>(elements_->elements()(b, e))]] +
                                   row / 3] += entry(e, a, b);
    return sum;
}

Eigen::MatrixXd FreeTangent::free_rows(const Eigen::MatrixXd& all) const {
    Eigen::MatrixXd rows(size(), all.cols());
    for (std::size_t i = 0; i < free_.size(); ++i)
        rows.middleRows<3>(3 * static_cast<Eigen::Index>(i)) = all.middleRows<3>(3 * free_[i]);
    return rows;
}

Eigen::MatrixXd FreeTangent::all_rows(const Eigen::MatrixXd& free) const {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(3 * elements_->n_nodes(), free.cols());
    for (std::size_t i = 0; i < free_.size(); ++i)
        all.middleRows<3>(3 * free_[i]) = free.middleRows<3>(3 * static_cast<Eigen::Index>(i));
    return all;
}

std::optional<SparseCholesky> factorised(const FreeTangent& tangent, const SparseMatrix& K, Control& control) {
    try {
        return SparseCholesky(tangent.analysis(), K, "tangent stiffness", &control);
    } catch (const NotPositiveDefiniteError&) {
        return std::nullopt;
    }
}

}  // namespace elastolab
