#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "base/control.hpp"
#include "deform/deformer.hpp"
#include "deform/grip.hpp"
#include "deform/grip_force.hpp"
#include "deform/grip_tangent.hpp"

namespace elastolab {

/// Rigid grips under forces, on a body of a method that is not linear.
struct GripEquilibrium {
    std::vector<Grip> grips;
    std::vector<GripForce> forces;
    std::vector<GripPlace> places;  ///< where they are in equilibrium
    Eigen::VectorXd values;         ///< as Deformer::displace takes them, with the grips at their places
    std::shared_ptr<const Equilibrium> equilibrium;
    GripTangent tangent;  ///< springs included
    int solves = 0;       ///< equilibria of the body that it took
    int iterations = 0;   ///< linear systems factorised for these

    /// Places under other forces, to first order: a linear system of 6 k unknowns.
    std::vector<GripPlace> places_under(const std::vector<GripForce>& others) const;
};

/// Finds it by Newton's method on the motions of the grips: each step is an equilibrium of the body with the grips
/// prescribed, and 6 k columns of its tangent. Steps go downhill where the grips are not stable (with moments, which
/// have no energy, only where the method's own steps find nothing stable), and are shortened where they overshoot or
/// the body finds no equilibrium; a state that is not stable is left along its softest motion.
/// deformer  of a method that is not linear
/// values    as Deformer::displace takes them; those of the grips are left out
/// approach  to the body's equilibrium with the grips at rest, where the search begins
/// before    an equilibrium of the same deformer and grips, where it begins instead; null: none
/// Throws SolveError where no motion balances the loads, NoEquilibriumError where none is found, Cancelled.
GripEquilibrium find_grip_equilibrium(const Deformer& deformer, const Eigen::VectorXd& values,
                                      const std::vector<Grip>& grips, const std::vector<GripForce>& forces,
                                      Control& control, const Approach& approach = {},
                                      const GripEquilibrium* before = nullptr);

}  // namespace elastolab
