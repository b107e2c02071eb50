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
    /// and for some more: distances are measured along the axes. `reach` must not decrease as the edge grows; it may
    /// shrink from one call to the next.
    template <class Reach, class Visit>
    void for_each_near(const Eigen::Vector3d& point, const Reach& reach, const Visit& visit) const;

private:
    struct Node {
        Eigen::AlignedBox3d box;
        double longest_edge = 0.0;  // of all triangles in it
        int begin = 0, end = 0;     // in triangles_
        int left = -1, right = -1;  // -1 in a leaf
    };
    int build(const SurfaceMesh& mesh, int begin, int end);
    bool visit_pairs_of(int place, const std::function<bool(int, int)>& visit) const;

    std::vector<int> triangles_;
    std::vector<Eigen::AlignedBox3d> boxes_;  // of triangles, in the order of triangles_
    std::vector<Node> nodes_;                 // the root first
};

namespace detail {

/// The largest distance along an axis between a point and a box; never more than the distance.
inline double distance_along_axes(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& point) {
    return std::max(0.0, (box.min() - point).cwiseMax(point - box.max()).maxCoeff());
}

}  // namespace detail

template <class Reach, class Visit>
void BoxTree::for_each_near(const Eigen::Vector3d& point, const Reach& reach, const Visit& visit) const {
    std::array<int, 96> stack{};  // the tree is balanced: its depth is below 32
    std::size_t depth = nodes_.empty() ? 0 : 1;
    while (depth > 0) {
        const Node& node = nodes_[static_cast<std::size_t>(stack[--depth])];
        if (detail::distance_along_axes(node.box, point) > reach(node.longest_edge)) continue;
        if (node.left >= 0) {
            stack[depth++] = node.right;
            stack[depth++] = node.left;
            continue;
        }
        for (auto i = static_cast<std::size_t>(node.begin); i < static_cast<std::size_t>(node.end); ++i)
            if (detail::distance_along_axes(boxes_[i], point) <= reach(node.longest_edge)) visit(triangles_[i]);
    }
}

}  // namespace elastolab
