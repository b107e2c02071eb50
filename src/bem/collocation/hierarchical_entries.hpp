#pragma once

#include <memory>
#include <span>
#include <vector>

#include "bem/boundary.hpp"
#include "bem/collocation/assembly.hpp"
#include "bem/hierarchical/cluster_tree.hpp"
#include "bem/hierarchical/hierarchical_matrix.hpp"
#include "elasticity/material.hpp"

namespace elastolab {

/// The shape functions of some elements, clustered by the triangles they extend over: columns of a collocation matrix.
class ClusteredElements {
public:
    ClusteredElements(const Boundary& boundary, Elements elements);

    const std::shared_ptr<const ClusterTree>& tree() const { return tree_; }
    int n_slots() const { return elements_.n_slots; }
    /// The elements that carry the slots at these positions of the tree; slots count from the beginning of the range.
    Elements at(PositionRange range) const;
    /// The elements that carry these slots, renumbered from 0 in this order.
    Elements of(std::span<const int> slots) const;

private:
    template <class Number>
    Elements collect(std::span<const int> slots, const Number& number) const;

    Elements elements_;
    std::vector<std::vector<int>> of_slot_;  ///< numbers of the elements
    std::shared_ptr<const ClusterTree> tree_;
};

/// One operator of the boundary integral equation without its free term (bem/collocation/assembly.hpp), seen from some
/// collocation points, as a hierarchical matrix. Immutable; any thread may use it.
class HierarchicalLayer {
public:
    /// Throws Cancelled.
    HierarchicalLayer(Layer layer, const Boundary& boundary, const CollocationPoints& points,
                      const ClusteredElements& elements, const Material& material, double tolerance,
                      const HierarchicalOptions& options, Control& control);

    /// Rows in the order of the collocation points, columns in that of the slots.
    Eigen::MatrixXd product(const Eigen::MatrixXd& X) const;
    /// The same for columns that are zero in most places. Throws Cancelled.
    Eigen::MatrixXd sparse_product(const SparseColumns& Z, Control& control) const;
    /// Entries of these collocation points and slots, as exactly as the matrix has them.
    Eigen::MatrixXd block(std::span<const int> points, std::span<const int> slots) const;
    std::uint64_t memory_bytes() const { return matrix_.memory_bytes(); }

private:
    std::shared_ptr<const ClusterTree> points_, elements_;
    HierarchicalMatrix matrix_;
};

/// The double layer of a whole surface with its free terms, H of bem/collocation/assembly.hpp: no rigid motion of the
/// body causes a traction, whatever the integrals and their approximation leave of it.
class HierarchicalDoubleLayer {
public:
    /// elements: those of bem/boundary.hpp, vertex_elements. modes: rigid ones of all vertices, orthonormal.
    /// Throws Cancelled.
    HierarchicalDoubleLayer(const Boundary& boundary, CollocationPoints points, const ClusteredElements& elements,
                            std::shared_ptr<const Eigen::MatrixXd> modes, const Material& material, double tolerance,
                            const HierarchicalOptions& options, Control& control);

    const CollocationPoints& points() const { return points_; }
    /// c(x) of each collocation point.
    const Eigen::Matrix3d& free_term(int source) const { return free_terms_[static_cast<std::size_t>(source)]; }
    Eigen::MatrixXd product(const Eigen::MatrixXd& U) const;
    /// The same for columns that are zero in most places. Throws Cancelled.
    Eigen::MatrixXd sparse_product(const SparseColumns& U, Control& control) const;
    /// Entries of these collocation points and slots (ascending).
    Eigen::MatrixXd block(std::span<const int> points, std::span<const int> slots) const;
    std::uint64_t memory_bytes() const { return layer_.memory_bytes(); }

private:
    void add_free_terms(const Eigen::MatrixXd& U, Eigen::MatrixXd& rows) const;

    CollocationPoints points_;
    std::shared_ptr<const Eigen::MatrixXd> modes_;
    HierarchicalLayer layer_;
    std::vector<Eigen::Matrix3d> free_terms_;
    Eigen::MatrixXd of_modes_;  ///< the layer times the rigid motions
};

}  // namespace elastolab
