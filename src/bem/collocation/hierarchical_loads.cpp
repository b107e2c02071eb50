#include "bem/collocation/hierarchical_loads.hpp"

#include <algorithm>
#include <utility>

#include "bem/collocation/hierarchical.hpp"
#include "bem/hierarchical/item_rows.hpp"
#include "bem/hierarchical/places.hpp"

namespace elastolab {

namespace {

/// How many slots of a space a generation and those before it have.
int n_known(const LoadGeneration& generation, const TractionSpace& space) {
    int n = 0;
    for (const TractionSpace::Block& block : space.blocks)
        if (generation.slots.contains(block.key)) n += block.n_slots;
    return n;
}

std::vector<int> looked_up(std::span<const int> numbers, const std::vector<int>& table) {
    std::vector<int> values;
    for (const int number : numbers) values.push_back(table[static_cast<std::size_t>(number)]);
    return values;
}

}  // namespace

LoadGeneration::LoadGeneration(const HierarchicalCollocation& matrices, const TractionSpace& space,
                               std::shared_ptr<const LoadGeneration> its_before, Control& control)
    : before(std::move(its_before)) {
    elements.order = space.elements.order;
    if (before) {
        depth = before->depth + 1;
        slots = before->slots;
        points = before->points;
        elements = before->elements;
        interior = before->interior;
        first_slot = elements.n_slots;
        first_point = interior.size();
    }
    const Elements earlier = elements;
    Elements added{elements.order, 0, {}};
    for (const TractionSpace::Block& block : space.blocks) {
        if (block.n_slots == 0 || !slots.try_emplace(block.key, elements.n_slots).second) continue;
        append(elements, block.elements, block.n_slots);
        append(added, block.elements, block.n_slots);
    }
    std::vector<int> triangles;
    for (const int t : space.interior_triangles)
        if (points.try_emplace(t, first_point + 3 * static_cast<int>(triangles.size())).second) triangles.push_back(t);
    const CollocationPoints new_points = inner_collocation_points(matrices.boundary(), triangles);
    interior.append(new_points);
    CollocationPoints everywhere = matrices.at_vertices().points();
    everywhere.append(interior);
    const auto single_layer = [&](const CollocationPoints& from, const Elements& of) {
        return std::make_unique<const HierarchicalLayer>(
            Layer::single_layer, matrices.boundary(), from, ClusteredElements(matrices.boundary(), merged(of)),
            matrices.material(), matrices.tolerance(), matrices.options(), control);
    };
    columns = single_layer(everywhere, added);
    if (triangles.empty()) return;
    if (before) rows = single_layer(new_points, earlier);
    seen = matrices.seen_from(new_points, control);
}

CollocationLoads::CollocationLoads(const HierarchicalCollocation& matrices, const TractionSpace& space,
                                   const std::vector<std::shared_ptr<const LoadGeneration>>& known, Control& control)
    : n_vertices_(matrices.elements().n_slots()) {
    std::shared_ptr<const LoadGeneration> last = best_generation(
        known, space.n_slots(), [&](const LoadGeneration& generation) { return n_known(generation, space); });
    n_new_slots_ = space.n_slots() - (last ? n_known(*last, space) : 0);
    if (!last || n_new_slots_ > 0)
        last = std::make_shared<const LoadGeneration>(matrices, space, std::move(last), control);
    for (const TractionSpace::Block& block : space.blocks)
        for (int s = 0; s < block.n_slots; ++s) slots_.push_back(last->slots.at(block.key) + s);
    for (const int t : space.interior_triangles)
        for (int k = 0; k < 3; ++k) points_.push_back(last->points.at(t) + k);
    generations_ = chain_of(std::move(last));
}

/// multiply(layer, some rows of tractions): of each generation; summed, and gathered for the set.
template <class Columns, class Multiply>
Eigen::MatrixXd CollocationLoads::sum_single_layers(const Columns& tractions, const Multiply& multiply) const {
    const Eigen::Index n = 3 * n_vertices_;
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n + 3 * last_generation()->interior.size(), tractions.cols());
    for (const auto& g : generations_) {
        const Eigen::Index first = 3 * g->first_slot, count = 3 * g->elements.n_slots - first;
        sum.topRows(n + 3 * g->interior.size()) += multiply(*g->columns, tractions.middleRows(first, count));
        if (g->rows)
            sum.middleRows(n + 3 * g->first_point, 3 * (g->interior.size() - g->first_point)) +=
                multiply(*g->rows, tractions.topRows(first));
    }
    Eigen::MatrixXd own(n + 3 * std::ssize(points_), sum.cols());
    own << sum.topRows(n), rows_of(sum.bottomRows(sum.rows() - n), points_);
    return own;
}

Eigen::MatrixXd CollocationLoads::single_layer(const Eigen::MatrixXd& X) const {
    Eigen::MatrixXd tractions = Eigen::MatrixXd::Zero(3 * last_generation()->elements.n_slots, X.cols());
    put_rows(X, slots_, tractions);
    return sum_single_layers(
        tractions, [](const HierarchicalLayer& layer, const Eigen::MatrixXd& some) { return layer.product(some); });
}

Eigen::MatrixXd CollocationLoads::single_layer(const SparseColumns& X, Control& control) const {
    return sum_single_layers(
        spread_over(X, slots_, last_generation()->elements.n_slots),
        [&](const HierarchicalLayer& layer, const SparseColumns& some) { return layer.sparse_product(some, control); });
}

Eigen::MatrixXd CollocationLoads::single_layer_block(std::span<const int> rows, std::span<const int> slots) const {
    std::vector<int> in_chain;
    for (const int row : rows)
        in_chain.push_back(row < n_vertices_ ? row
                                             : n_vertices_ + points_[static_cast<std::size_t>(row - n_vertices_)]);
    const std::vector<int> columns = looked_up(slots, slots_);
    Eigen::MatrixXd A(3 * std::ssize(rows), 3 * std::ssize(slots));
    for (const auto& g : generations_) {
        const NumbersWithin its(columns, g->first_slot, g->elements.n_slots);
        const NumbersWithin upper(in_chain, 0, n_vertices_ + g->interior.size());
        A(upper.places, its.places) = g->columns->block(upper.numbers, its.numbers);
        if (!g->rows) continue;
        const NumbersWithin earlier(columns, 0, g->first_slot);
        const NumbersWithin lower(in_chain, n_vertices_ + g->first_point, n_vertices_ + g->interior.size());
        A(lower.places, earlier.places) = g->rows->block(lower.numbers, earlier.numbers);
    }
    return A;
}

template <class Multiply>
Eigen::MatrixXd CollocationLoads::stack_double_layers(Eigen::Index cols, const Multiply& multiply) const {
    Eigen::MatrixXd all(3 * last_generation()->interior.size(), cols);
    for (const auto& g : generations_)
        if (g->seen) all.middleRows(3 * g->first_point, 3 * (g->interior.size() - g->first_point)) = multiply(*g->seen);
    return rows_of(all, points_);
}

Eigen::MatrixXd CollocationLoads::double_layer(const Eigen::MatrixXd& U) const {
    return stack_double_layers(U.cols(), [&](const HierarchicalDoubleLayer& seen) { return seen.product(U); });
}

Eigen::MatrixXd CollocationLoads::double_layer(const SparseColumns& U, Control& control) const {
    return stack_double_layers(U.cols(),
                               [&](const HierarchicalDoubleLayer& seen) { return seen.sparse_product(U, control); });
}

Eigen::MatrixXd CollocationLoads::double_layer_block(std::span<const int> interior,
                                                     std::span<const int> vertices) const {
    const std::vector<int> in_chain = looked_up(interior, points_);
    Eigen::MatrixXd A(3 * std::ssize(interior), 3 * std::ssize(vertices));
    for (const auto& g : generations_) {
        if (!g->seen) continue;
        const NumbersWithin its(in_chain, g->first_point, g->interior.size());
        A(its.places, Eigen::all) = g->seen->block(its.numbers, vertices);
    }
    return A;
}

std::uint64_t CollocationLoads::memory_bytes() const {
    std::uint64_t bytes = 0;
    for (const auto& g : generations_)
        bytes += g->columns->memory_bytes() + (g->rows ? g->rows->memory_bytes() : 0) +
                 (g->seen ? g->seen->memory_bytes() : 0);
    return bytes;
}

}  // namespace elastolab
