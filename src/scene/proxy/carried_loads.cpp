#include "scene/proxy/carried_loads.hpp"

#include "mesh/closest_point.hpp"
#include "mesh/measures.hpp"

namespace elastolab {

namespace {

/// Edges of the proxy that a triangle of a filled surface may be from itself: rounding.
constexpr double kSameTriangle = 1e-6;

/// The shown triangle that the middle of each triangle of the proxy is nearest to; -1 where loads have no effect, and
/// where the proxy fills a hole.
std::vector<int> nearest_triangles(const Proxy& proxy, const ConstrainedSet& held) {
    const SurfaceMesh& surface = *proxy.surface;
    std::vector<char> is_held(static_cast<std::size_t>(surface.n_vertices()), 0);
    for (const std::vector<int>* vertices : {&held.fixed, &held.handles})
        for (const int v : *vertices) is_held[static_cast<std::size_t>(v)] = 1;
    std::vector<int> nearest(static_cast<std::size_t>(surface.n_triangles()), -1);
    const ClosestPoint closest(*proxy.shown);
    for (int t = 0; t < surface.n_triangles(); ++t) {
        const Eigen::Vector3i v = surface.triangles.col(t);
        if (is_held[static_cast<std::size_t>(v[0])] && is_held[static_cast<std::size_t>(v[1])] &&
            is_held[static_cast<std::size_t>(v[2])])
            continue;
        const SurfacePoint found = closest(centroid(surface, t));
        if (!proxy.is_filled() || found.distance <= kSameTriangle * proxy.edge)
            nearest[static_cast<std::size_t>(t)] = found.triangle;
    }
    return nearest;
}

/// The triangles of the proxy that carry what these shown ones do.
std::vector<int> carried_triangles(const Proxy& proxy, const std::vector<int>& shown, const std::vector<int>& nearest) {
    std::vector<char> is_loaded(static_cast<std::size_t>(proxy.shown->n_triangles()), 0);
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const int t : shown) {
        is_loaded[static_cast<std::size_t>(t)] = 1;
        middle += centroid(*proxy.shown, t) / static_cast<double>(shown.size());
    }
    std::vector<int> triangles;
    for (std::size_t t = 0; t < nearest.size(); ++t)
        if (nearest[t] >= 0 && is_loaded[static_cast<std::size_t>(nearest[t])] != 0)
            triangles.push_back(static_cast<int>(t));
    if (triangles.empty()) triangles.push_back(ClosestPoint(*proxy.surface)(middle).triangle);
    return triangles;
}

}  // namespace

std::vector<AppliedLoad> carried_loads(const Proxy& proxy, const std::vector<AppliedLoad>& shown,
                                       const ConstrainedSet& held) {
    if (shown.empty()) return {};
    const std::vector<int> nearest = nearest_triangles(proxy, held);
    std::vector<AppliedLoad> carried = shown;
    for (AppliedLoad& load : carried)
        if (load.kind != AppliedLoad::Kind::gravity) load.triangles = carried_triangles(proxy, load.triangles, nearest);
    return carried;
}

}  // namespace elastolab
