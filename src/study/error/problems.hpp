#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "deform/deformer.hpp"
#include "deform/model.hpp"

namespace elastolab {

/// A displacement problem whose answer is known.
struct Problem {
    Body body;
    std::vector<int> constrained;
    Eigen::VectorXd truth;                    ///< of all vertices, 3*n_vertices
    double truth_error = 0.0;                 ///< how far the truth itself may be off, relative; 0: exact
    std::optional<Reactions> reactions = {};  ///< true ones at the constrained vertices, where they are known
    double truth_force_error = 0.0;           ///< how far those may be off, as force_error() measures it
    std::vector<UnitLoad> loads = {};
    Eigen::VectorXd factors = {};  ///< of the loads

    ConstrainedSet set() const { return {{}, constrained, loads}; }
    /// As a Deformer takes them for set(): displacements of the constrained vertices, then the factors of the loads.
    Eigen::VectorXd values() const;
    /// Root mean square error over the free vertices, relative to that of their true displacements.
    double error(const Eigen::VectorXd& u) const;
    /// Largest error of a vertex, relative to the largest true displacement.
    double largest_error(const Eigen::VectorXd& u) const;
    /// Error of the reactions of the worst patch, over the largest (deform/patch_reactions.hpp), for those at the
    /// constrained vertices. Nothing where the true ones are unknown, or add up to nothing on every patch.
    std::optional<double> force_error(const Reactions& at_constrained) const;
};

/// Problems of one kind in all sizes. Their surface is free of traction except where it is constrained or loaded.
///   rotation            bar of 2 x 1 x 1, vertices moved at random, both ends turned by the same rotation
///   stretch             the same bar pulled along its axis
///   bending             bar of 2 x 1 x 1 in pure bending, both ends prescribed
///   bending-irregular   the same, vertices moved at random in their faces
///   torsion             circular cylinder twisted, both ends prescribed: a curved free side
///   torsion-irregular   the same, vertices moved at random on the surface
///   hollow-sphere       inner sphere displaced, outer free: curved everywhere, two surfaces
///   hanging-bar         bar that hangs from its top under its weight
///   pressed-sphere      hollow sphere under inner pressure, constrained nowhere
///   pressed-bar         bar under pressure on its sides, both ends prescribed
///   finite-...          large deformations of a neo-Hookean body (study/error/finite_problems.hpp): a rotation by 60
///                       degrees and a stretch by a half, a bar bent by 60 degrees, a cylinder twisted by 60, a hollow
///                       sphere that swells by a half
///   cantilever          bar of 3 x 1 x 1, fixed at one end and bent by its weight; truth as of organic bodies
///   rabbit, potato, cactus   organic bodies pulled at a small patch; ...-turned: the patch turned by 20 degrees. Truth
///                       by quadratic FEM graded towards the rims, refined and extrapolated, which shares no code with
///                       the paper's three methods but the sparse solver
struct ProblemFamily {
    std::string name;
    std::string truth;  ///< how the truth is known, in words
    bool organic = false;
    bool reproduced = false;  ///< linear elements represent the field exactly: the error is rounding
    /// `size`: cells of the primitive, or vertices of an organic body.
    std::function<Problem(int size, double poisson_ratio)> make;
    bool finite = false;  ///< large deformations, for methods that are not linear
};

const std::vector<ProblemFamily>& problem_families();
const ProblemFamily& problem_family(const std::string& name);

}  // namespace elastolab
