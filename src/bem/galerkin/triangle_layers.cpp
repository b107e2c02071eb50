#include "bem/galerkin/triangle_layers.hpp"

#include <algorithm>
#include <utility>

#include "bem/hierarchical/item_rows.hpp"
#include "bem/hierarchical/places.hpp"

namespace elastolab {

namespace {

constexpr int kTrianglesOfALeaf = 48;

/// How many of some triangles a generation and those before it have.
int n_known_triangles(const TriangleGeneration& generation, const std::vector<int>& triangles) {
    return static_cast<int>(std::ranges::count_if(triangles, [&](int t) { return generation.items.contains(t); }));
}

/// Rows of a generation, in the order of its tree.
Eigen::MatrixXd tree_rows(const Eigen::MatrixXd& all, const TriangleGeneration& g) {
    return to_tree_order(*g.tree, all.middleRows(3 * g.first_item, 3 * g.tree->size()));
}

void add_tree_rows(const Eigen::MatrixXd& by_position, const TriangleGeneration& g, Eigen::MatrixXd& all) {
    all.middleRows(3 * g.first_item, 3 * g.tree->size()) += to_item_order(*g.tree, by_position);
}

}  // namespace

TriangleGeneration::TriangleGeneration(const LayerSource& source, const std::vector<int>& triangles,
                                       std::shared_ptr<const TriangleGeneration> its_before, Control& control)
    : before(std::move(its_before)) {
    if (before) {
        depth = before->depth + 1;
        items = before->items;
        first_item = before->n_items();
    }
    std::vector<int> added;
    for (const int t : triangles)
        if (items.try_emplace(t, first_item + static_cast<int>(added.size())).second) added.push_back(t);
    tree = source.pairs->cluster_triangles(added, kTrianglesOfALeaf);
    ordered = in_order(added, *tree);
    const auto make = [&](const std::shared_ptr<const ClusterTree>& cols, bool symmetric, const BlockEntries& entries) {
        return std::make_unique<const HierarchicalMatrix>(tree, cols, symmetric, entries, source.options, control);
    };
    K = make(source.vertex_tree, false,
             DoubleLayerEntries(source.pairs, added, *tree, source.vertex_tree, source.material));
    V = make(tree, true, SingleLayerEntries(source.pairs, ordered, ordered, source.material));
    for (const auto& g : chain_of(before))
        V_earlier.push_back(
            make(g->tree, false, SingleLayerEntries(source.pairs, ordered, g->ordered, source.material)));
}

TriangleLayers::TriangleLayers(const LayerSource& source, const std::vector<int>& triangles,
                               const std::vector<std::shared_ptr<const TriangleGeneration>>& known, Control& control) {
    const int n = static_cast<int>(triangles.size());
    const auto n_known = [&](const TriangleGeneration& g) { return n_known_triangles(g, triangles); };
    std::shared_ptr<const TriangleGeneration> last = best_generation(known, n, n_known);
    n_new_ = n - (last ? n_known(*last) : 0);
    if (!last || n_new_ > 0)
        last = std::make_shared<const TriangleGeneration>(source, triangles, std::move(last), control);
    for (const int t : triangles) items_.push_back(last->items.at(t));
    generations_ = chain_of(std::move(last));
}

Eigen::MatrixXd TriangleLayers::spread(const Eigen::MatrixXd& t) const {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(3 * last_generation()->n_items(), t.cols());
    put_rows(t, items_, all);
    return all;
}

Eigen::MatrixXd TriangleLayers::double_layer(const Eigen::MatrixXd& u) const {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(3 * last_generation()->n_items(), u.cols());
    for (const auto& g : generations_) add_tree_rows(g->K->product(u), *g, all);
    return rows_of(all, items_);
}

Eigen::MatrixXd TriangleLayers::transposed_double_layer(const Eigen::MatrixXd& t) const {
    const Eigen::MatrixXd all = spread(t);
    Eigen::MatrixXd f = Eigen::MatrixXd::Zero(generations_.front()->K->cols(), t.cols());
    for (const auto& g : generations_) f += g->K->transposed_product(tree_rows(all, *g));
    return f;
}

Eigen::MatrixXd TriangleLayers::single_layer(const Eigen::MatrixXd& t) const {
    const Eigen::MatrixXd all = spread(t);
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(all.rows(), all.cols());
    for (const auto& g : generations_) {
        const Eigen::MatrixXd own = tree_rows(all, *g);
        add_tree_rows(g->V->product(own), *g, sum);
        for (std::size_t e = 0; e < g->V_earlier.size(); ++e) {
            const TriangleGeneration& earlier = *generations_[e];
            add_tree_rows(g->V_earlier[e]->product(tree_rows(all, earlier)), *g, sum);
            add_tree_rows(g->V_earlier[e]->transposed_product(own), earlier, sum);
        }
    }
    return rows_of(sum, items_);
}

Eigen::MatrixXd TriangleLayers::single_layer_block(std::span<const int> numbers) const {
    std::vector<int> items;
    for (const int number : numbers) items.push_back(items_[static_cast<std::size_t>(number)]);
    Eigen::MatrixXd A(3 * std::ssize(items), 3 * std::ssize(items));
    std::vector<NumbersWithin> inside;
    std::vector<Places> places;
    for (const auto& g : generations_) {
        inside.emplace_back(items, g->first_item, g->n_items());
        places.emplace_back(*g->tree, inside.back().numbers);
        const NumbersWithin& own = inside.back();
        const Places& at = places.back();
        A(own.places, own.places) = g->V->submatrix(at.positions, at.positions)(at.of_items, at.of_items);
        for (std::size_t e = 0; e < g->V_earlier.size(); ++e) {
            const Eigen::MatrixXd block = g->V_earlier[e]->submatrix(at.positions, places[e].positions);
            A(own.places, inside[e].places) = block(at.of_items, places[e].of_items);
            A(inside[e].places, own.places) = block.transpose()(places[e].of_items, at.of_items);
        }
    }
    return A;
}

Eigen::MatrixXd TriangleLayers::galerkin_product(const SparseColumns& Z, Control& control) const {
    const SparseColumns all = spread_over(Z, items_, last_generation()->n_items());
    Eigen::MatrixXd E = Eigen::MatrixXd::Zero(Z.cols(), Z.cols());
    std::vector<SparseColumns> by_generation;
    for (const auto& g : generations_) {
        const SparseColumns rows = all.middleRows(3 * g->first_item, 3 * g->tree->size());
        by_generation.push_back(to_tree_order(*g->tree, rows));
        E += g->V->galerkin_product(by_generation.back(), control);
        for (std::size_t e = 0; e < g->V_earlier.size(); ++e) {
            const Eigen::MatrixXd product = g->V_earlier[e]->sparse_product(by_generation[e], control);
            const Eigen::MatrixXd mixed = by_generation.back().transpose() * product;
            E += mixed + mixed.transpose();
        }
    }
    return E;
}

std::vector<std::vector<int>> TriangleLayers::clusters(int n) const {
    std::vector<int> numbers(static_cast<std::size_t>(last_generation()->n_items()), -1);
    for (int number = 0; number < n_triangles(); ++number)
        numbers[static_cast<std::size_t>(items_[static_cast<std::size_t>(number)])] = number;
    std::vector<std::vector<int>> clusters;
    for (const auto& g : generations_)
        for (const PositionRange& range : clusters_up_to(*g->tree, n)) {
            std::vector<int> own;
            for (int position = range.begin; position < range.end; ++position) {
                const int item = g->first_item + g->tree->order()[static_cast<std::size_t>(position)];
                if (const int number = numbers[static_cast<std::size_t>(item)]; number >= 0) own.push_back(number);
            }
            if (!own.empty()) clusters.push_back(std::move(own));
        }
    return clusters;
}

std::uint64_t TriangleLayers::memory_bytes() const {
    std::uint64_t bytes = 0;
    for (const auto& g : generations_) {
        bytes += g->K->memory_bytes() + g->V->memory_bytes();
        for (const auto& V : g->V_earlier) bytes += V->memory_bytes();
    }
    return bytes;
}

}  // namespace elastolab
