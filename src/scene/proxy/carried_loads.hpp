#pragma once

#include <span>
#include <vector>

#include "deform/unit_load.hpp"
#include "scene/constraints.hpp"
#include "scene/proxy/proxy.hpp"

namespace elastolab {

/// Loads of the shown surface on the triangles of a proxy whose constrained vertices are those of `held`. A triangle of
/// the proxy carries what the shown triangle that its middle is nearest to carries, unless all its vertices are
/// constrained; what closes a hole and the rims of a sheet's wall carry nothing, and of the wall the side that the
/// shown triangles face. A load that no triangle would carry acts on the one that is nearest to its middle.
std::vector<AppliedLoad> carried_loads(const Proxy& proxy, const std::vector<AppliedLoad>& shown,
                                       const ConstrainedSet& held);

/// The unit loads of a carried load in place of its own on the shown surface (one each). Of a total force and, where
/// the shown surface bounds solids or the proxy carries them on as large an area, of tractions, force and moment are
/// those of the shown ones, for which tractions differ a little from the given ones. Pressures stay what they are.
std::vector<UnitLoad> carried_units(const Proxy& proxy, const AppliedLoad& carried, std::span<const UnitLoad> shown);

}  // namespace elastolab
