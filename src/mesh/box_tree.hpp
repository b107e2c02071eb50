#pragma once

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

private:
    struct Node {
        Eigen::AlignedBox3d box;
        int begin = 0, end = 0;     // in triangles_
        int left = -1, right = -1;  // -1 in a leaf
    };
    int build(const SurfaceMesh& mesh, int begin, int end);
    bool visit_pairs_of(int place, const std::function<bool(int, int)>& visit) const;

    std::vector<int> triangles_;
    std::vector<Eigen::AlignedBox3d> boxes_;  // of triangles, in the order of triangles_
    std::vector<Node> nodes_;                 // the root first
};

}  // namespace elastolab
