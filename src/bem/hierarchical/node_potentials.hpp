#pragma once

#include <Eigen/Core>

#include "bem/hierarchical/interpolation_nodes.hpp"

namespace elastolab {

/// Columns for each load of the potentials below.
inline constexpr int kNodePotentials = 15;

/// Adds what forces g at the nodes y of one cluster do at the nodes x of another, with r = x - y: sum g / |r| (three
/// columns), sum r (r . g) / |r|^3 (three), and row by row sum r g^T / |r|^3 (nine), which is minus the gradient of the
/// first: what Kelvin's solution and its tractions are made of (docs/formulation.md sections 7 and 13).
/// forces: source.size() x 3*n_loads; sum: field.size() x kNodePotentials*n_loads. No node of one may be one of the
/// other.
void add_node_potentials(const InterpolationNodes& field, const InterpolationNodes& source,
                         const Eigen::MatrixXd& forces, Eigen::MatrixXd& sum);

}  // namespace elastolab
