#pragma once

#include <cstddef>
#include <vector>

#include "mesh/topology.hpp"
#include "scene/constraints.hpp"
#include "scene/proxy/proxy.hpp"

namespace elastolab {

/// A shown vertex that is constrained (share 1) or near one that is.
struct Follower {
    int vertex;
    std::size_t group;
    int member;          ///< place in the group; -1 when it is only near
    double share;        ///< of what the constrained vertex that it follows is moved by beyond its place on the proxy
    std::size_t source;  ///< which follower that is: itself where it is constrained
};

/// The shown vertices whose displacements are not those of their places on the proxy alone. Constrained ones go exactly
/// where they are put; the difference fades out around them within one edge of the proxy, and at once where the proxy
/// is the shown surface with its holes filled, or where each vertex has a motion of its own. around: the triangles of
/// the shown vertices.
std::vector<Follower> find_followers(const Proxy& proxy, const VertexTriangles& around, const Constraints& shown);

}  // namespace elastolab
