#pragma once

#include "study/error/problems.hpp"

namespace elastolab {

// Problems with loads whose answers are known. Lengths of about 1, Young's modulus 1.

/// A bar of 1 x 1 x 1 that hangs from its top, where it is displaced as the exact solution is (Timoshenko and Goodier,
/// section 100), under this weight per volume: quadratic displacements, stress linear along the bar.
Problem hanging_bar(int cells, double poisson_ratio, double weight = 1.0);

/// A hollow sphere of outer radius 1 under a unit pressure on its inner side, by Lame's solution. Nothing is
/// constrained: the pressure balances itself.
Problem pressed_sphere(int cells, double poisson_ratio, double inner_radius = 0.5);

/// A bar of 2 x 1 x 1 under a unit pressure on its four sides, stretched between its ends: linear displacements, which
/// linear elements represent, at nu = 1/2 too.
Problem pressed_bar(int cells, double poisson_ratio);

/// A bar of length x 1 x 1 that is fixed at one end and bent by a unit weight. Displacements by quadratic finite
/// elements graded towards the rim of the fixed end and extrapolated; the total force and moment of its support are
/// exact.
Problem cantilever(int cells, double poisson_ratio, double length = 3.0);

}  // namespace elastolab
