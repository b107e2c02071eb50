#pragma once

#include "study/error/problems.hpp"

namespace elastolab {

// Large deformations of a neo-Hookean body whose answers are known: by formulas, or by an ordinary differential
// equation for the one function that equilibrium leaves unknown (radial_equilibrium.hpp). Young's modulus 1.

/// A bar of 2 x 1 x 1, vertices moved at random, both ends turned by the same angle [degree].
Problem finite_rotation(int cells, double poisson_ratio, double angle = 60.0);

/// The same stretched to `stretch` times its length, its sides free: uniform.
Problem finite_stretch(int cells, double poisson_ratio, double stretch = 1.5);

/// A bar of 2 x 1 x 1 bent to a sector of a cylinder by this angle [degree], its width held (plane strain): inner and
/// outer face free. Source of the form: Rivlin, Large elastic deformations of isotropic materials V, 1949.
Problem finite_bending(int cells, double poisson_ratio, double angle = 60.0);

/// A circular cylinder, radius 1/2 and height 2, whose ends are twisted against each other by this angle [degree] at
/// constant height; its side is free and draws in.
Problem finite_torsion(int cells, double poisson_ratio, double angle = 60.0);

/// A hollow sphere of outer radius 1 whose inner side is pushed out from radius 1/2 to 1/2 * stretch; the outer is
/// free.
Problem finite_swelling(int cells, double poisson_ratio, double stretch = 1.5);

}  // namespace elastolab
