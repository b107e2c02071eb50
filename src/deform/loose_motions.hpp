#pragma once

#include <Eigen/Core>
#include <vector>

#include "deform/deformer.hpp"
#include "deform/grip.hpp"

namespace elastolab {

/// Solids that a grip joins have one number. solid_of: for each vertex of the body the number of its solid, from 0 on;
/// handles: those of the constrained set, to which the grips refer.
std::vector<int> joined_by_grips(std::vector<int> solid_of, const std::vector<int>& handles,
                                 const std::vector<Grip>& grips);

/// Rigid motions of the solids with grips that nothing but the grips holds: up to six for all solids that grips join.
struct LooseMotions {
    /// As motions of the grips in GripArms::units (6 k rows) that move some of their vertices: orthonormal columns.
    Eigen::MatrixXd motions;
    /// What each load of size one of the constrained set does in each of them [force]: motions x loads.
    Eigen::MatrixXd work;
};
/// arms: those of the grips.
LooseMotions loose_motions(const Deformer& deformer, const std::vector<Grip>& grips, const GripArms& arms);

}  // namespace elastolab
