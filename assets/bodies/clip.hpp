#pragma once

#include "bodies/patchwork.hpp"
#include "bodies/solid.hpp"

namespace elastolab::bodies {

/// The surface of a solid, found on a grid of tetrahedra over its box: every sheet is made linear in each of them and
/// cuts off what is outside it. Closed, manifold and oriented outward, sharp edges included; the triangles are badly
/// shaped. Features thinner than a cell of the grid may be lost.
Patchwork clip(const Solid& solid);

}  // namespace elastolab::bodies
