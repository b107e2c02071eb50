#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/control.hpp"
#include "deform/deformer.hpp"
#include "deform/grip.hpp"
#include "deform/grip_equilibrium.hpp"
#include "deform/grip_tangent.hpp"

namespace elastolab {

/// Rigid grips under forces, and how the forces that hold them change with their motions.
struct GripsInPlace {
    std::vector<Grip> grips;
    std::vector<GripPlace> places;  ///< at rest by methods that are linear
    Eigen::MatrixXd stiffness;      ///< GripStiffness::matrix, or GripTangent::stiffness without springs
};
GripsInPlace in_place(const GripStiffness& stiffness);
/// equilibrium: without springs
GripsInPlace in_place(const GripEquilibrium& equilibrium);

/// Corrects the check of an answer in which some grips are under forces. It compares with a better answer to the same
/// motions, which takes other forces there; under the same forces the grips of the better answer are elsewhere: to
/// first order by the motion that these forces cause. An error of the stiffness is one of displacements, then, and not
/// of forces. (A stiffness that is off by a factor r: the correction over the answer is |1 - r|, as is the error over
/// the better answer.)
/// values, answer: of the deformer, grips included, `answer.check` asked for; without one nothing is done, and where
/// that motion cannot be solved for, there is none afterwards. Throws Cancelled.
void correct_check(const Deformer& deformer, const Eigen::VectorXd& values, const GripsInPlace& grips,
                   Deformer::Answer& answer, Control& control);

}  // namespace elastolab
