#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "bem/boundary.hpp"
#include "bem/galerkin/close_pairs_kept.hpp"
#include "bem/hierarchical/cluster_tree.hpp"
#include "bem/hierarchical/low_rank.hpp"
#include "elasticity/material.hpp"
#include "elasticity/pair_integrals.hpp"

namespace elastolab {

/// Size of the leaves of a tree of vertices.
constexpr int kVerticesOfALeaf = 48;

/// The pairs of triangles of one boundary, for the entries of all its Galerkin operators.
class BoundaryPairs {
public:
    /// tolerance: relative, of the integrals of one pair (elasticity/pair_integrals.hpp).
    BoundaryPairs(std::shared_ptr<const Boundary> boundary, double tolerance);

    const Boundary& boundary() const { return *boundary_; }
    const PairIntegrals& integrals() const { return integrals_; }
    /// Integrals to a hundred times the tolerance, for far blocks, which are approximated less exactly than that.
    const PairIntegrals& far_integrals() const { return far_integrals_; }
    const TriangleGeometry& triangle(int t) const { return triangles_[static_cast<std::size_t>(t)]; }
    const Eigen::Matrix3d& curls(int t) const { return curls_[static_cast<std::size_t>(t)]; }
    const std::vector<int>& triangles_at(int vertex) const { return at_vertex_[static_cast<std::size_t>(vertex)]; }

    /// Clusters of vertices (with the triangles around them) and of these triangles.
    std::shared_ptr<const ClusterTree> cluster_vertices(int leaf_size) const;
    std::shared_ptr<const ClusterTree> cluster_triangles(std::span<const int> triangles, int leaf_size) const;
    /// Every close pair, integrated. Throws Cancelled.
    std::shared_ptr<const KeptClosePairs> keep_close_pairs(Control& control) const;

private:
    std::shared_ptr<const Boundary> boundary_;
    std::vector<TriangleGeometry> triangles_;
    std::vector<Eigen::Matrix3d> curls_;
    std::vector<std::vector<int>> at_vertex_;
    PairIntegrals integrals_, far_integrals_;
};

/// Entries made of integrals over pairs: the same ones for close blocks and, less exactly, for far ones.
class PairEntries : public BlockEntries {
public:
    void fill(PositionRange rows, PositionRange cols, Eigen::Ref<Eigen::MatrixXd> out) const final {
        fill_with(pairs_->integrals(), rows, cols, out);
    }
    void fill_far(PositionRange rows, PositionRange cols, Eigen::Ref<Eigen::MatrixXd> out) const final {
        fill_with(pairs_->far_integrals(), rows, cols, out);
    }

protected:
    explicit PairEntries(std::shared_ptr<const BoundaryPairs> pairs) : pairs_(std::move(pairs)) {}
    const BoundaryPairs& pairs() const { return *pairs_; }

private:
    virtual void fill_with(const PairIntegrals& integrals, PositionRange rows, PositionRange cols,
                           Eigen::Ref<Eigen::MatrixXd> out) const = 0;

    std::shared_ptr<const BoundaryPairs> pairs_;
};

/// The hypersingular operator D between vertices (bem/galerkin/hypersingular.hpp); rows and columns in the order of
/// `tree`.
class HypersingularEntries : public PairEntries {
public:
    /// close: the close pairs, if they are kept, or null.
    HypersingularEntries(std::shared_ptr<const BoundaryPairs> pairs, std::shared_ptr<const ClusterTree> tree,
                         const Material& material, std::shared_ptr<const KeptClosePairs> close = nullptr);

private:
    void fill_with(const PairIntegrals& integrals, PositionRange rows, PositionRange cols,
                   Eigen::Ref<Eigen::MatrixXd> out) const override;

    std::shared_ptr<const ClusterTree> tree_;
    std::shared_ptr<const KeptClosePairs> close_;
    double alpha_, beta_;
};

/// Some triangles in the order of a tree, item i of which is triangles[i].
std::vector<int> in_order(const std::vector<int>& triangles, const ClusterTree& tree);

/// The single layer V between some triangles and others, or the same (bem/galerkin/traction_rows.hpp).
class SingleLayerEntries : public PairEntries {
public:
    /// rows, cols: triangle at each position.
    SingleLayerEntries(std::shared_ptr<const BoundaryPairs> pairs, std::vector<int> rows, std::vector<int> cols,
                       const Material& material);

private:
    void fill_with(const PairIntegrals& integrals, PositionRange rows, PositionRange cols,
                   Eigen::Ref<Eigen::MatrixXd> out) const override;

    std::vector<int> rows_, cols_;
    Material material_;
};

/// The double layer K with half the mass matrix: rows of some triangles, columns of all vertices.
class DoubleLayerEntries : public PairEntries {
public:
    DoubleLayerEntries(std::shared_ptr<const BoundaryPairs> pairs, const std::vector<int>& triangles,
                       const ClusterTree& triangle_tree, std::shared_ptr<const ClusterTree> vertex_tree,
                       const Material& material);

private:
    void fill_with(const PairIntegrals& integrals, PositionRange rows, PositionRange cols,
                   Eigen::Ref<Eigen::MatrixXd> out) const override;

    std::vector<int> ordered_;
    std::shared_ptr<const ClusterTree> vertex_tree_;
    double nu_;
};

}  // namespace elastolab
