#include "scene/proxy/followers.hpp"

#include <unordered_map>
#include <utility>
#include <variant>

#include "scene/proxy/proxy_owners.hpp"

namespace elastolab {

/// A walk over the shown surface, outwards from what is constrained.
std::vector<Follower> find_followers(const Proxy& proxy, const VertexTriangles& around, const Constraints& shown) {
    const SurfaceMesh& mesh = *proxy.shown;
    std::vector<Follower> followers;
    std::unordered_map<int, std::size_t> source_of;  // the follower that a seen vertex is nearest to, so far
    for (std::size_t g = 0; g < shown.groups.size(); ++g) {
        const std::vector<int> vertices = vertices_of(shown, g);
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            source_of[vertices[i]] = followers.size();
            followers.push_back({vertices[i], g, static_cast<int>(i), 1.0, followers.size()});
        }
    }
    const std::size_t n_constrained = followers.size();
    std::vector<std::pair<int, std::size_t>> front;  // a vertex, and where it was reached from
    for (std::size_t i = 0; i < n_constrained; ++i) front.emplace_back(followers[i].vertex, i);
    const double reach = proxy.is_filled() ? 0.0 : proxy.edge;
    std::unordered_map<int, double> distances;
    while (!front.empty()) {
        std::vector<std::pair<int, std::size_t>> next;
        for (const auto& [vertex, source] : front)
            for (const int t : around[vertex])
                for (const int w : mesh.triangles.col(t)) {
                    const auto known = source_of.find(w);
                    if (known != source_of.end() && !distances.contains(w)) continue;
                    const double d = (mesh.vertices.col(w) - mesh.vertices.col(followers[source].vertex)).norm();
                    const auto before = distances.find(w);
                    if (d >= reach || (before != distances.end() && before->second <= d)) continue;
                    distances[w] = d;
                    source_of[w] = source;
                    next.emplace_back(w, source);
                }
        front = std::move(next);
    }
    for (const auto& [vertex, d] : distances) {
        const std::size_t group = followers[source_of[vertex]].group;
        const std::size_t first_handle = shown.has_fixed() ? 1 : 0;
        const bool is_vertexwise =
            group >= first_handle && std::holds_alternative<VertexMotion>(shown.motions[group - first_handle]);
        const double fade = 1.0 - d / reach;
        if (!is_vertexwise) followers.push_back({vertex, group, -1, fade * fade, source_of[vertex]});
    }
    return followers;
}

}  // namespace elastolab
