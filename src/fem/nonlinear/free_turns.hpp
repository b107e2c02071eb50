#pragma once

#include <Eigen/Core>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Where nothing holds a body, it may be turned without any work: about every axis under loads that follow its surface,
/// and about the direction of dead forces that all have the same. Of these equilibria the one whose nodes are nearest
/// to rest, by root mean square; the mean of the displacements stays.
/// rest         positions of the nodes, 3 x n [L]
/// u            an equilibrium, 3*n [L]
/// dead_forces  at the nodes, 3 x n; those that follow the surface left out
Eigen::VectorXd turned_to_rest(const Positions& rest, const Eigen::VectorXd& u, const Eigen::Matrix3Xd& dead_forces);

}  // namespace elastolab
