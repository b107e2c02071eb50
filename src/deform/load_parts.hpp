#pragma once

#include <vector>

#include "deform/unit_load.hpp"

namespace elastolab {

/// The part of a load that acts on some triangles: number of each triangle among these, -1 for others. A body force is
/// the same everywhere.
UnitLoad on_triangles(const UnitLoad& load, const std::vector<int>& numbers);

}  // namespace elastolab
