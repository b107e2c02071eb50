#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "deform/method.hpp"

namespace elastolab {

/// What may be said of a mesh, a material, a constrained set or a solution. `value` means, by kind:
enum class FindingKind {
    locking,             ///< Poisson's ratio, near 1/2, of a method that locks
    uncertain_pressure,  ///< Poisson's ratio, so near 1/2 that stresses are; `first` 1: a whole surface is constrained
    lost_digits,         ///< condition number of `object`, large enough to lose digits
    singular_stiffness,  ///< K = G^-1 H with G singular to rounding
    thin_triangle,       ///< altitude over longest edge of a triangle whose integrals lose digits
    slender_body,        ///< length over thickness
    thin_wall,           ///< distance of the other side over the edge of a triangle there
    contact,             ///< solids number `first` and `second` touch but are separate bodies
    point_constraint,    ///< how many vertices are constrained without a whole constrained triangle; `first` is one
    weak_hold,           ///< by how much an error of a handle is amplified
    free_motion,         ///< the constraints leave the body free to move; the smallest motion is taken
    singular_though_held,  ///< the constraints hold the body, and yet their system is singular
    coarse_mesh,           ///< estimated error of the displacement of the worst vertex, over the largest displacement
    coarse_forces,         ///< estimated error of the reactions of the worst patch, over the largest
    no_estimate,           ///< the error of an answer is not estimated: its second answer takes too much time or memory
    force_imbalance,       ///< resultant of all reaction forces, over the largest
    moment_imbalance,      ///< resultant of all reaction moments, over the largest
    nothing_constrained,   ///< no vertex of the scene `object` is fixed or moved
    choice_left_aside,     ///< the option `object` means nothing to the method, it is one of `method`
    impossible_volume,     ///< change of volume over volume, of an incompressible solid that is held all over
    large_residual,        ///< relative residual of the solution
    proxy,                 ///< a closed surface of `first` vertices stands for the mesh `object`; its largest distance
    chosen_proxy,          ///< the same of a mesh that could be simulated itself
    capped_holes,          ///< how many holes of the mesh `object` a proxy closes
    filled_holes,          ///< how many holes of the mesh `object` are filled, by `first` triangles
    linear_theory,         ///< how far linear theory is off, over the largest displacement; infinite: no equilibrium
    unstable_equilibrium,  ///< an equilibrium that the least push makes the body leave
    thin_sheets,           ///< sheets of the mesh `object`, with `first` openings, became walls; their thickness
    idle_handle,           ///< the handle `object` has no vertex of the proxy, as others hold those near it
    narrow_openings,       ///< how many openings of the mesh `object` a proxy closes though they were to stay open
};

enum class Severity {
    note,     ///< good to know
    warning,  ///< some of the answer is less accurate than one would believe
    error     ///< the answer is not to be believed
};

/// One thing that the user should know; worded at the edge (findings/words.hpp).
struct Finding {
    FindingKind kind = FindingKind::locking;
    Severity severity = Severity::warning;
    double value = 0.0;
    MethodKind method = nullptr;                ///< of which it is said, where that matters
    std::optional<Eigen::Vector3d> place = {};  ///< [L]
    int first = -1, second = -1;  ///< vertex or solids, by kind; coarse_mesh: vertex, constrained ones (0: refine);
                                  ///< linear_theory: 1 where nonlinear FEM does not take the Poisson's ratio
    std::string object = {};      ///< what it is said of, where the kind does not tell
    int n_more = 0;               ///< other solids of which the same is true to a lesser degree
};

using Findings = std::vector<Finding>;

}  // namespace elastolab
