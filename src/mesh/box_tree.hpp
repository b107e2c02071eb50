#pragma once

#include <algorithm>
#include <array>
#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// A binary tree of boxes around the triangles of a mesh.
class BoxTree {
public:
    /// A tree of these triangles only. Their vertices must be finite.
    BoxTree(const SurfaceMesh& mesh, std::vector<int> triangles);

    /// Calls visit(s, t), once for every pair of triangles whose boxes touch, until it returns false.
    void for_each_close_pair(const std::function<bool(int, int)>& visit) const;

    /// Calls visit(t) for every triangle whose box is no farther from a point than reach(longest edge of the triangle),
    /// and for some more, near ones first. `reach` must not decrease as the edge grows; it may shrink from one call to
    /// the next.
    template <class Reach, class Visit>
    void for_each_near(const Eigen::Vector3d& point, const Reach& reach, const Visit& visit) const;

private:
    struct Node {
        Eigen::AlignedBox3d box;
        double longest_edge = 0.0;  // of all triangles in it
        int begin = 0, end = 0;     // in triangles_
        int left = -1, right = -1;  // -1 in a leaf
    };
    struct Item;
    int build(std::vector<Item>& items, int begin, int end);
    bool visit_pairs_of(int place, const std::function<bool(int, int)>& visit) const;

    std::vector<int> triangles_;              // in the order of the leaves
    std::vector<Eigen::AlignedBox3d> boxes_;  // of triangles, in the order of triangles_
    std::vector<Node> nodes_;                 // the root first
};

template <class Reach, class Visit>
void BoxTree::for_each_near(const Eigen::Vector3d& point, const Reach& reach, const Visit& visit) const {
    struct Waiting {
        int node;
        double distance;
    };
    const auto waiting = [&](int node) {
        return Waiting{node, nodes_[static_cast<std::size_t>(node)].box.exteriorDistance(point)};
    };
    std::array<Waiting, 96> stack;  // the tree is balanced: its depth is below 32
    std::size_t depth = 0;
    if (!nodes_.empty()) stack[depth++] = waiting(0);
    while (depth > 0) {
        const auto [place, distance] = stack[--depth];
        const Node& node = nodes_[static_cast<std::size_t>(place)];
        if (distance > reach(node.longest_edge)) continue;
        if (node.left >= 0) {
            const Waiting left = waiting(node.left), right = waiting(node.right);
            stack[depth++] = left.distance < right.distance ? right : left;
            stack[depth++] = left.distance < right.distance ? left : right;
            continue;
        }
        for (auto i = static_cast<std::size_t>(node.begin); i < static_cast<std::size_t>(node.end); ++i)
            if (boxes_[i].exteriorDistance(point) <= reach(node.longest_edge)) visit(triangles_[i]);
    }
}

}  // namespace elastolab
