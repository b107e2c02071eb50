#include "bem/collocation/hierarchical_entries.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "bem/hierarchical/places.hpp"

namespace elastolab {

namespace {

constexpr int kItemsOfALeaf = 48;

std::shared_ptr<const ClusterTree> cluster_points(const Positions& points) {
    std::vector<Eigen::AlignedBox3d> boxes;
    for (const auto& point : points.colwise()) boxes.emplace_back(Eigen::Vector3d(point));
    return std::make_shared<const ClusterTree>(boxes, kItemsOfALeaf);
}

/// Entries of one layer; in far blocks, which are approximated anyway, integrals are less exact.
class CollocationEntries : public BlockEntries {
public:
    CollocationEntries(Layer layer, const Boundary& boundary, const CollocationPoints& points,
                       const ClusterTree& source_tree, const ClusteredElements& elements, const Material& material,
                       double tolerance, double far_tolerance)
        : layer_(layer),
          boundary_(boundary),
          ordered_(points.subset(source_tree.order())),
          elements_(elements),
          material_(material),
          tolerance_(tolerance),
          far_tolerance_(std::max(tolerance, far_tolerance)) {}

    void fill(PositionRange rows, PositionRange cols, Eigen::Ref<Eigen::MatrixXd> out) const override {
        fill_to(tolerance_, rows, cols, out);
    }
    void fill_far(PositionRange rows, PositionRange cols, Eigen::Ref<Eigen::MatrixXd> out) const override {
        fill_to(far_tolerance_, rows, cols, out);
    }

private:
    void fill_to(double tolerance, PositionRange rows, PositionRange cols, Eigen::Ref<Eigen::MatrixXd> out) const {
        std::vector<int> numbers(static_cast<std::size_t>(rows.size()));
        std::iota(numbers.begin(), numbers.end(), rows.begin);
        integrate_block(layer_, boundary_, ordered_.subset(numbers), elements_.at(cols), material_, tolerance, out);
    }

    Layer layer_;
    const Boundary& boundary_;
    CollocationPoints ordered_;
    const ClusteredElements& elements_;
    Material material_;
    double tolerance_, far_tolerance_;
};

/// Tolerance of the integrals in a far block over that of the block.
constexpr double kFarIntegralError = 0.1;

}  // namespace

ClusteredElements::ClusteredElements(const Boundary& boundary, Elements elements)
    : elements_(std::move(elements)), of_slot_(static_cast<std::size_t>(elements_.n_slots)) {
    std::vector<Eigen::AlignedBox3d> boxes(of_slot_.size());
    for (std::size_t e = 0; e < elements_.elements.size(); ++e)
        for (const int slot : elements_.elements[e].slots) {
            if (slot < 0) continue;
            of_slot_[static_cast<std::size_t>(slot)].push_back(static_cast<int>(e));
            for (const int v : boundary.mesh().triangles.col(elements_.elements[e].triangle))
                boxes[static_cast<std::size_t>(slot)].extend(boundary.mesh().vertices.col(v));
        }
    tree_ = std::make_shared<const ClusterTree>(boxes, kItemsOfALeaf);
}

Elements ClusteredElements::at(PositionRange range) const {
    const auto begin = tree_->order().begin();
    return collect(std::span(begin + range.begin, begin + range.end), [&](int slot) {
        const int position = tree_->positions()[static_cast<std::size_t>(slot)];
        return range.contains(position) ? position - range.begin : -1;
    });
}

Elements ClusteredElements::of(std::span<const int> slots) const {
    std::vector<int> numbers(of_slot_.size(), -1);
    for (std::size_t i = 0; i < slots.size(); ++i) numbers[static_cast<std::size_t>(slots[i])] = static_cast<int>(i);
    return collect(slots, [&](int slot) { return numbers[static_cast<std::size_t>(slot)]; });
}

/// number: of a slot among `slots`, or -1.
template <class Number>
Elements ClusteredElements::collect(std::span<const int> slots, const Number& number) const {
    Elements some{elements_.order, static_cast<int>(slots.size()), {}};
    for (int i = 0; i < some.n_slots; ++i)
        for (const int e : of_slot_[static_cast<std::size_t>(slots[static_cast<std::size_t>(i)])]) {
            const Elements::Element& whole = elements_.elements[static_cast<std::size_t>(e)];
            Elements::Element part{whole.triangle, {-1, -1, -1}};
            int first = i;
            for (std::size_t k = 0; k < 3; ++k) {
                if (whole.slots[k] < 0) continue;
                part.slots[k] = number(whole.slots[k]);
                if (part.slots[k] >= 0) first = std::min(first, part.slots[k]);
            }
            if (first == i) some.elements.push_back(part);  // else it came with the slot at `first`
        }
    return some;
}

HierarchicalLayer::HierarchicalLayer(Layer layer, const Boundary& boundary, const CollocationPoints& points,
                                     const ClusteredElements& elements, const Material& material, double tolerance,
                                     const HierarchicalOptions& options, Control& control)
    : points_(cluster_points(points.positions)),
      elements_(elements.tree()),
      matrix_(points_, elements_, false,
              CollocationEntries(layer, boundary, points, *points_, elements, material, tolerance,
                                 kFarIntegralError * options.tolerance),
              options, control) {}

Eigen::MatrixXd HierarchicalLayer::product(const Eigen::MatrixXd& X) const {
    return to_item_order(*points_, matrix_.product(to_tree_order(*elements_, X)));
}

Eigen::MatrixXd HierarchicalLayer::sparse_product(const SparseColumns& Z, Control& control) const {
    return to_item_order(*points_, matrix_.sparse_product(to_tree_order(*elements_, Z), control));
}

Eigen::MatrixXd HierarchicalLayer::block(std::span<const int> points, std::span<const int> slots) const {
    const Places rows(*points_, points), cols(*elements_, slots);
    return matrix_.submatrix(rows.positions, cols.positions)(rows.of_items, cols.of_items);
}

HierarchicalDoubleLayer::HierarchicalDoubleLayer(const Boundary& boundary, CollocationPoints points,
                                                 const ClusteredElements& elements,
                                                 std::shared_ptr<const Eigen::MatrixXd> modes, const Material& material,
                                                 double tolerance, const HierarchicalOptions& options, Control& control)
    : points_(std::move(points)),
      modes_(std::move(modes)),
      layer_(Layer::double_layer, boundary, points_, elements, material, tolerance, options, control) {
    const Eigen::MatrixXd sums = layer_.product(Eigen::Matrix3d::Identity().replicate(elements.n_slots(), 1));
    for (int source = 0; source < points_.size(); ++source) free_terms_.push_back(-sums.middleRows<3>(3 * source));
    of_modes_ = layer_.product(*modes_);
}

Eigen::MatrixXd HierarchicalDoubleLayer::product(const Eigen::MatrixXd& U) const {
    Eigen::MatrixXd bent = U;
    bent.noalias() -= *modes_ * (modes_->transpose() * U).eval();
    Eigen::MatrixXd rows = layer_.product(bent);
    add_free_terms(bent, rows);
    return rows;
}

Eigen::MatrixXd HierarchicalDoubleLayer::sparse_product(const SparseColumns& U, Control& control) const {
    const Eigen::MatrixXd shares = modes_->transpose() * U;
    Eigen::MatrixXd rows = layer_.sparse_product(U, control);
    rows.noalias() -= of_modes_ * shares;
    Eigen::MatrixXd bent = U;
    bent.noalias() -= *modes_ * shares;
    add_free_terms(bent, rows);
    return rows;
}

void HierarchicalDoubleLayer::add_free_terms(const Eigen::MatrixXd& U, Eigen::MatrixXd& rows) const {
    for (int source = 0; source < points_.size(); ++source)
        for (const CollocationPoints::Weight& weight : points_.weights[static_cast<std::size_t>(source)])
            if (weight.slot >= 0)
                rows.middleRows<3>(3 * source) += weight.value * (free_term(source) * U.middleRows<3>(3 * weight.slot));
}

Eigen::MatrixXd HierarchicalDoubleLayer::block(std::span<const int> points, std::span<const int> slots) const {
    Eigen::MatrixXd A = layer_.block(points, slots);
    for (std::size_t row = 0; row < points.size(); ++row)
        for (const CollocationPoints::Weight& weight : points_.weights[static_cast<std::size_t>(points[row])]) {
            const auto at = std::lower_bound(slots.begin(), slots.end(), weight.slot);
            if (at != slots.end() && *at == weight.slot)
                A.block<3, 3>(3 * static_cast<Eigen::Index>(row), 3 * (at - slots.begin())) +=
                    weight.value * free_term(points[row]);
        }
    return A;
}

}  // namespace elastolab
