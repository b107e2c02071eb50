#pragma once

#include <Eigen/Core>
#include <vector>

#include "bem/boundary.hpp"

namespace elastolab {

/// The closed surfaces of one solid: its outer one and those of its cavities. The hypersingular operator annihilates
/// the rigid motions of each of them by itself.
struct ClosedSurfaces {
    std::vector<std::vector<int>> triangles;  ///< of each surface, ascending
    std::vector<int> surface_of_triangle;
    /// 3V x 6 n_surfaces, orthonormal columns: the rigid motions of each surface, zero on the others.
    Eigen::MatrixXd rigid;

    explicit ClosedSurfaces(const SurfaceMesh& mesh);
    int size() const { return static_cast<int>(triangles.size()); }
};

/// 3n x 6: a + omega x x at the centroids of these n triangles, about their mean and with lengths scaled to about 1.
Eigen::MatrixXd rigid_tractions(const Boundary& boundary, const std::vector<int>& triangles);

}  // namespace elastolab
