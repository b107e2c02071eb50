#pragma once

#include <Eigen/Core>
#include <vector>

#include "deform/deformer.hpp"
#include "deform/grip.hpp"

namespace elastolab {

/// Rigid motions of the solids with grips that nothing but the grips holds, as motions of these (6 k rows, in
/// GripArms::units) that move some of their vertices: orthonormal columns, up to six for all solids that grips join.
/// arms: those of the grips.
Eigen::MatrixXd loose_motions(const Deformer& deformer, const std::vector<Grip>& grips, const GripArms& arms);

}  // namespace elastolab
