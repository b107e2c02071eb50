#pragma once

#include <span>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// True when fixing the nodes leaves the body no rigid motion: three of them that do not lie on one line. Their spread
/// must exceed 1e-6 of the body's size.
bool holds(const Positions& positions, std::span<const int> nodes);

}  // namespace elastolab
