#pragma once

#include "deform/deformer.hpp"

namespace elastolab {

/// Work of the loads on the displacements of an answer, int g . u dS + int b . u dV [force * L]: the compliance, which
/// a stiffer body has less of. The integral over the volume follows from the surface by reciprocity with the field u' =
/// -(1 - 2 nu)/E [(b . x) x - |x|^2 b / 2] of that body force (docs/formulation.md section 13):
///   int b . u dV = int b . u' dV + int g . u' dS + sum over the supports R . u' + int (b . x) n . u dS,
/// with displacements and u' linear on each triangle.
double work_of_loads(const Model& model, const ConstrainedSet& set, const Eigen::VectorXd& values,
                     const Deformer::Answer& answer);

}  // namespace elastolab
