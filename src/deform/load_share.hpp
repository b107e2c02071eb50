#pragma once

#include <Eigen/Core>
#include <vector>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Part of the force of a load slot that one constrained vertex carries:
/// force += weight * load,  moment about the origin += first_moment x load;  psi is its part of the shape function.
struct LoadShare {
    int slot = 0;
    int constrained = 0;                                     ///< position in the list of constrained vertices
    double weight = 0.0;                                     ///< int psi dS (nodal forces: 1)
    Eigen::Vector3d first_moment = Eigen::Vector3d::Zero();  ///< int psi y dS
};

/// A load slot per vertex, carrying a force at its position.
std::vector<LoadShare> nodal_shares(const Positions& positions, const std::vector<int>& vertices);

}  // namespace elastolab
