#pragma once

#include <cstddef>
#include <Eigen/Core>
#include <vector>

#include "base/control.hpp"
#include "bem/galerkin/boundary_entries.hpp"
#include "elasticity/material.hpp"

namespace elastolab {

/// Tractions g that are constant on each of some triangles, a column for each load.
struct PiecewiseTractions {
    std::vector<int> triangles;  ///< ascending
    Eigen::MatrixXd values;      ///< 3*triangles.size() x n_loads
};

/// How layers are computed.
struct LayerOptions {
    const PairIntegrals& near;            ///< of the triangles of the boundary; must outlive the call
    double far_tolerance;                 ///< of what distant triangles do, relative
    std::size_t most_bytes = 512u << 20;  ///< of what distant triangles do to clusters; other loads wait for their turn
};

/// K^T g at every vertex and, below it, V g on every triangle (bem/galerkin/traction_rows.hpp), (3*n_vertices +
/// 3*n_triangles) x n_loads, node-major. No matrix is made: pairs of triangles that are near each other are integrated,
/// and what distant clusters of triangles do is interpolated in their boxes. The result does not depend on the
/// number of threads. Throws Cancelled. Source: W. Fong and E. Darve, J. Comput. Phys. 228 (2009), without the transfer
/// from cluster to cluster; K by Guenter's derivatives of the same two potentials.
Eigen::MatrixXd layers_of_tractions(const BoundaryPairs& pairs, const Material& material,
                                    const PiecewiseTractions& given, const LayerOptions& options, Control& control);

}  // namespace elastolab
