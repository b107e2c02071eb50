#include "mesh/box_tree.hpp"

#include <algorithm>
#include <array>

#include "mesh/checks/nesting.hpp"
#include "mesh/measures.hpp"

namespace elastolab {

using Eigen::AlignedBox3d;

namespace {

double longest_edge_of(const SurfaceMesh& mesh, std::span<const int> triangles) {
    double longest = 0.0;
    for (const int t : triangles) {
        const TrianglePoints p = triangle_points(mesh, t);
        longest = std::max({longest, (p.b - p.a).norm(), (p.c - p.b).norm(), (p.a - p.c).norm()});
    }
    return longest;
}

}  // namespace

BoxTree::BoxTree(const SurfaceMesh& mesh, std::vector<int> triangles) : triangles_(std::move(triangles)) {
    if (triangles_.empty()) return;
    build(mesh, 0, static_cast<int>(triangles_.size()));
    for (const int t : triangles_) boxes_.push_back(bounding_box(mesh, std::array{t}));
}

int BoxTree::build(const SurfaceMesh& mesh, int begin, int end) {
    constexpr int kLeaf = 4;
    const auto first = triangles_.begin() + begin, last = triangles_.begin() + end, middle = first + (end - begin) / 2;
    const int index = static_cast<int>(nodes_.size());
    nodes_.push_back({bounding_box(mesh, {first, last}), longest_edge_of(mesh, {first, last}), begin, end});
    if (end - begin <= kLeaf) return index;
    Eigen::Index axis = 0;
    nodes_.back().box.sizes().maxCoeff(&axis);
    const auto center = [&](int t) {
        const auto v = mesh.triangles.col(t);
        return mesh.vertices(axis, v[0]) + mesh.vertices(axis, v[1]) + mesh.vertices(axis, v[2]);
    };
    std::nth_element(first, middle, last, [&](int s, int t) { return center(s) < center(t); });
    const int cut = begin + (end - begin) / 2;
    const int left = build(mesh, begin, cut), right = build(mesh, cut, end);
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
