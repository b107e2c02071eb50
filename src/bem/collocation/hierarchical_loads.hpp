#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "base/control.hpp"
#include "bem/collocation/hierarchical_entries.hpp"
#include "bem/collocation/traction_space.hpp"
#include "bem/hierarchical/generations.hpp"
#include "deform/columns.hpp"

namespace elastolab {

class HierarchicalCollocation;

/// Traction unknowns that were integrated at the same time, after those of earlier generations.
struct LoadGeneration {
    /// Unknowns of `space` that no generation before has, and their interior points. before: or null. Throws Cancelled.
    LoadGeneration(const HierarchicalCollocation& matrices, const TractionSpace& space,
                   std::shared_ptr<const LoadGeneration> before, Control& control);

    int n_items() const { return elements.n_slots; }

    std::shared_ptr<const LoadGeneration> before;
    int depth = 1;
    // Of this generation and those before:
    std::map<ColumnKey, int> slots;  ///< first one of each block of a traction space
    std::map<int, int> points;       ///< first one of each triangle with interior points
    Elements elements;
    CollocationPoints interior;
    // Of this generation alone:
    int first_slot = 0, first_point = 0;
    std::unique_ptr<const HierarchicalLayer> columns;     ///< at all vertices, then at all points, of the new slots
    std::unique_ptr<const HierarchicalLayer> rows;        ///< at the new points, of the earlier slots; or null
    std::unique_ptr<const HierarchicalDoubleLayer> seen;  ///< H from the new points, or null
};

/// What one constrained set adds to H of linear collocation: the single layer of its tractions, and H seen from its
/// interior points. Unknowns and points that a living set of the same body has as well are not integrated again.
/// Immutable; any thread may use it.
class CollocationLoads {
public:
    /// known: generations that may be built upon. Throws Cancelled.
    CollocationLoads(const HierarchicalCollocation& matrices, const TractionSpace& space,
                     const std::vector<std::shared_ptr<const LoadGeneration>>& known, Control& control);

    int n_slots() const { return static_cast<int>(slots_.size()); }
    int n_interior() const { return static_cast<int>(points_.size()); }
    /// Slots that were integrated for this set.
    int n_new_slots() const { return n_new_slots_; }
    const std::shared_ptr<const LoadGeneration>& last_generation() const { return generations_.back(); }

    /// G X: rows of all vertices, then of the interior points; columns in the order of the slots.
    Eigen::MatrixXd single_layer(const Eigen::MatrixXd& X) const;
    Eigen::MatrixXd single_layer(const SparseColumns& X, Control& control) const;
    /// Entries at some of these rows (vertices, then n_vertices + interior point) and columns.
    Eigen::MatrixXd single_layer_block(std::span<const int> rows, std::span<const int> slots) const;
    /// H U at the interior points.
    Eigen::MatrixXd double_layer(const Eigen::MatrixXd& U) const;
    Eigen::MatrixXd double_layer(const SparseColumns& U, Control& control) const;
    /// Entries at some interior points and some vertices (ascending).
    Eigen::MatrixXd double_layer_block(std::span<const int> interior, std::span<const int> vertices) const;

    std::uint64_t memory_bytes() const;

private:
    template <class Columns, class Multiply>
    Eigen::MatrixXd sum_single_layers(const Columns& tractions, const Multiply& multiply) const;
    template <class Multiply>
    Eigen::MatrixXd stack_double_layers(Eigen::Index cols, const Multiply& multiply) const;

    int n_vertices_, n_new_slots_ = 0;
    std::vector<std::shared_ptr<const LoadGeneration>> generations_;  ///< oldest first
    std::vector<int> slots_, points_;                                 ///< of the set, among those of the generations
};

}  // namespace elastolab
