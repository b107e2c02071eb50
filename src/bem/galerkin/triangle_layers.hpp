#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "base/control.hpp"
#include "bem/galerkin/boundary_entries.hpp"
#include "bem/hierarchical/generations.hpp"
#include "bem/hierarchical/hierarchical_matrix.hpp"

namespace elastolab {

/// What the layers of some triangles are made from.
struct LayerSource {
    std::shared_ptr<const BoundaryPairs> pairs;
    std::shared_ptr<const ClusterTree> vertex_tree;
    Material material;
    HierarchicalOptions options;
};

/// Triangles that were integrated at the same time, after those of earlier generations.
struct TriangleGeneration {
    /// Those triangles that no generation before has. before: or null. Throws Cancelled.
    TriangleGeneration(const LayerSource& source, const std::vector<int>& triangles,
                       std::shared_ptr<const TriangleGeneration> before, Control& control);

    int n_items() const { return static_cast<int>(items.size()); }

    std::shared_ptr<const TriangleGeneration> before;
    int depth = 1;
    std::map<int, int> items;  ///< number of each triangle of this generation and those before
    // Of this generation alone:
    int first_item = 0;
    std::vector<int> ordered;  ///< triangle at each position
    std::shared_ptr<const ClusterTree> tree;
    std::unique_ptr<const HierarchicalMatrix> K, V;
    std::vector<std::unique_ptr<const HierarchicalMatrix>> V_earlier;  ///< columns of each generation, oldest first
};

/// The operators V and K of the Galerkin equations (bem/galerkin/traction_rows.hpp) at some triangles, hierarchical.
/// Triangles that living layers of the same boundary have as well are not integrated again. Rows at triangles are in
/// their given order, three each; displacements are in the order of the vertices' cluster tree. Immutable; any thread
/// may use it.
class TriangleLayers {
public:
    /// known: generations that may be built upon. Throws Cancelled.
    TriangleLayers(const LayerSource& source, const std::vector<int>& triangles,
                   const std::vector<std::shared_ptr<const TriangleGeneration>>& known, Control& control);

    int n_triangles() const { return static_cast<int>(items_.size()); }
    /// Triangles that were integrated for these.
    int n_new_triangles() const { return n_new_; }
    const std::shared_ptr<const TriangleGeneration>& last_generation() const { return generations_.back(); }

    /// K u, K^T t, V t
    Eigen::MatrixXd double_layer(const Eigen::MatrixXd& u) const;
    Eigen::MatrixXd transposed_double_layer(const Eigen::MatrixXd& t) const;
    Eigen::MatrixXd single_layer(const Eigen::MatrixXd& t) const;
    /// V between some of the triangles, by number.
    Eigen::MatrixXd single_layer_block(std::span<const int> numbers) const;
    /// Z^T V Z, three rows of Z for each triangle. Throws Cancelled.
    Eigen::MatrixXd galerkin_product(const SparseColumns& Z, Control& control) const;
    /// Numbers of the triangles in clusters of at most n, near each other: each triangle in one of them.
    std::vector<std::vector<int>> clusters(int n) const;

    std::uint64_t memory_bytes() const;

private:
    Eigen::MatrixXd spread(const Eigen::MatrixXd& t) const;

    std::vector<std::shared_ptr<const TriangleGeneration>> generations_;  ///< oldest first
    std::vector<int> items_;  ///< number of each triangle among those of the generations
    int n_new_ = 0;
};

}  // namespace elastolab
