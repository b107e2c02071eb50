#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "mesh/closest_point.hpp"
#include "scene/constraints.hpp"
#include "scene/proxy/proxy.hpp"

namespace elastolab {

// Which vertices of a proxy are constrained by the constraints of the shown surface, and by which of them.

/// The shown vertices of one of the constraints' groups.
std::vector<int> vertices_of(const Constraints& constraints, std::size_t group);

/// The constrained parts of the shown surface, one for each group. Their vertices are those of the group, in its order;
/// their triangles first each vertex by itself (three equal corners), then those whose corners are all in the group.
std::vector<SurfaceMesh> constrained_parts(const SurfaceMesh& shown, const Constraints& constraints);

/// What a vertex of the proxy belongs to.
struct ProxyOwner {
    static constexpr std::size_t kNobody = std::numeric_limits<std::size_t>::max();
    static constexpr double kReach = 0.35;  ///< how far from its owner it may be, in mean edges of the proxy

    std::size_t group = kNobody;
    SurfacePoint point{-1, Eigen::Vector3d::Zero(), std::numeric_limits<double>::infinity()};  ///< of the group's part
    std::size_t fixed_set = 0;  ///< where the group is the fixed part
};

/// The owner of every vertex of the proxy: the nearest part within ProxyOwner::kReach. Each connected piece of a part
/// that is smaller than the proxy's triangles gets the corners of the nearest one, or, of less than three vertices, the
/// nearest vertex. Of the fixed part, a vertex belongs to the set of the shown
/// vertex that it is nearest to. Where the proxy is the shown surface with its holes filled, vertices belong to
/// themselves. parts: constrained_parts() of these constraints.
std::vector<ProxyOwner> proxy_owners(const Proxy& proxy, const Constraints& shown,
                                     const std::vector<SurfaceMesh>& parts);

}  // namespace elastolab
