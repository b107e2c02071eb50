#pragma once

#include <vector>

#include "scene/constraints.hpp"
#include "scene/proxy/proxy.hpp"

namespace elastolab {

/// Loads of the shown surface on the triangles of a proxy whose constrained vertices are those of `held`. A triangle of
/// the proxy carries what the shown triangle that its middle is nearest to carries, unless all its vertices are
/// constrained. A load that no triangle would carry acts on the one that is nearest to its middle. A total force stays
/// the same, whatever the area.
std::vector<AppliedLoad> carried_loads(const Proxy& proxy, const std::vector<AppliedLoad>& shown,
                                       const ConstrainedSet& held);

}  // namespace elastolab
