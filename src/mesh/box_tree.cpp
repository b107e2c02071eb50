#include "mesh/box_tree.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "mesh/measures.hpp"

namespace elastolab {

using Eigen::AlignedBox3d;

/// What of a triangle a node is made from.
struct BoxTree::Item {
    Item(const SurfaceMesh& mesh, int t) : triangle(t) {
        const TrianglePoints p = triangle_points(mesh, t);
        for (const Eigen::Vector3d* corner : {&p.a, &p.b, &p.c}) box.extend(*corner);
        sum = p.a + p.b + p.c;
        longest_edge = std::max({(p.b - p.a).norm(), (p.c - p.b).norm(), (p.a - p.c).norm()});
    }
    AlignedBox3d box;
    Eigen::Vector3d sum;  ///< of the corners
    double longest_edge;
    int triangle;
};

BoxTree::BoxTree(const SurfaceMesh& mesh, std::vector<int> triangles) {
    if (triangles.empty()) return;
    std::vector<Item> items;
    items.reserve(triangles.size());
    for (const int t : triangles) items.emplace_back(mesh, t);
    build(items, 0, static_cast<int>(items.size()));
    triangles_ = std::move(triangles);
    boxes_.reserve(items.size());
    for (std::size_t i = 0; i < items.size(); ++i) {
        triangles_[i] = items[i].triangle;
        boxes_.push_back(items[i].box);
    }
}

int BoxTree::build(std::vector<Item>& items, int begin, int end) {
    constexpr int kLeaf = 4;
    const auto first = items.begin() + begin, last = items.begin() + end;
    const int index = static_cast<int>(nodes_.size());
    Node node{.box = {}, .longest_edge = 0.0, .begin = begin, .end = end};
    for (auto item = first; item != last; ++item) {
        node.box.extend(item->box);
        node.longest_edge = std::max(node.longest_edge, item->longest_edge);
    }
    nodes_.push_back(node);
    if (end - begin <= kLeaf) return index;
    Eigen::Index axis = 0;
    node.box.sizes().maxCoeff(&axis);
    const int cut = begin + (end - begin) / 2;
    std::nth_element(first, items.begin() + cut, last,
                     [&](const Item& a, const Item& b) { return a.sum[axis] < b.sum[axis]; });
    const int left = build(items, begin, cut), right = build(items, cut, end);
    nodes_[static_cast<std::size_t>(index)].left = left;
    nodes_[static_cast<std::size_t>(index)].right = right;
    return index;
}

void BoxTree::for_each_close_pair(const std::function<bool(int, int)>& visit) const {
    for (int place = 0; place < static_cast<int>(triangles_.size()); ++place)
        if (!visit_pairs_of(place, visit)) return;
}

/// Pairs with later triangles only, so that each pair comes once.
bool BoxTree::visit_pairs_of(int place, const std::function<bool(int, int)>& visit) const {
    const auto at = static_cast<std::size_t>(place);
    std::array<int, 96> stack{};  // the tree is balanced: its depth is below 32
    std::size_t depth = 1;
    while (depth > 0) {
        const Node& node = nodes_[static_cast<std::size_t>(stack[--depth])];
        if (node.end <= place + 1 || !node.box.intersects(boxes_[at])) continue;
        if (node.left >= 0) {
            stack[depth++] = node.left;
            stack[depth++] = node.right;
            continue;
        }
        for (auto i = static_cast<std::size_t>(std::max(node.begin, place + 1)); i < static_cast<std::size_t>(node.end);
             ++i)
            if (boxes_[i].intersects(boxes_[at]) && !visit(triangles_[at], triangles_[i])) return false;
    }
    return true;
}

}  // namespace elastolab
