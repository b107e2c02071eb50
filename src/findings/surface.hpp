#pragma once

#include <span>
#include <vector>

#include "base/control.hpp"
#include "deform/finding.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

// What a method does badly on a surface, found before anybody believes its result. The limits come from measurements
// that are named here; tests/findings/findings_test.cpp repeats them.

/// Of methods that integrate over the surface (MethodTraits::integrates_boundary), else nothing:
///   thin_triangle  altitude / longest edge so small (below 5e-5) that the integrals keep fewer than six digits
///   slender_body   of collocation: more than 15 times as long, along the surface where it is wound, as thick
///                  (4 volume / area). Bars of two cells across in bending are 9 % off at 20 times and 15 % at 40 times
///                  by linear elements, 29 % and 36 % by constant ones, below 0.1 % by Galerkin BEM
///   thin_wall      walls or gaps thinner than half the edges beside them, or 0.8 of them with constant elements:
///                  below that, a bent plate of 8 x 8 cells is 3 to 9 % off by linear elements, 35 to 44 % by constant
///                  ones, up to 2 % by Galerkin BEM
/// Throws Cancelled.
Findings findings_of_surface(const SurfaceMesh& surface, MethodKind method, Control& control);

/// Solids that come closer than a hundredth of an edge, and yet are separate bodies. parts: the vertices of each solid
/// in the mesh.
Findings findings_of_contact(const SurfaceMesh& surface, std::span<const std::vector<int>> parts);

}  // namespace elastolab
