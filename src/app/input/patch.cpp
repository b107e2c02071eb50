#include "app/input/patch.hpp"

#include "mesh/topology.hpp"

namespace elastolab {

VertexGraph::VertexGraph(const SurfaceMesh& mesh) : offsets_(static_cast<std::size_t>(mesh.n_vertices()) + 1, 0) {
    const EdgeTable edges(mesh);
    for (int e = 0; e < edges.size(); ++e)
        for (const int v : {edges[e].a, edges[e].b}) ++offsets_[static_cast<std::size_t>(v) + 1];
    for (std::size_t v = 1; v < offsets_.size(); ++v) offsets_[v] += offsets_[v - 1];
    neighbours_.resize(static_cast<std::size_t>(offsets_.back()));
    std::vector<int> next(offsets_.begin(), offsets_.end() - 1);
    for (int e = 0; e < edges.size(); ++e) {
        const auto [a, b] = edges[e];
        neighbours_[static_cast<std::size_t>(next[static_cast<std::size_t>(a)]++)] = b;
        neighbours_[static_cast<std::size_t>(next[static_cast<std::size_t>(b)]++)] = a;
    }
}

std::span<const int> VertexGraph::operator[](int vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    return {neighbours_.data() + offsets_[v], neighbours_.data() + offsets_[v + 1]};
}

std::vector<int> patch_around(const SurfaceMesh& mesh, const VertexGraph& graph, int center, double radius) {
    std::vector<int> patch = {center};
    std::vector<char> seen(static_cast<std::size_t>(mesh.n_vertices()), 0);
    seen[static_cast<std::size_t>(center)] = 1;
    for (std::size_t next = 0; next < patch.size(); ++next)
        for (const int v : graph[patch[next]]) {
            if (seen[static_cast<std::size_t>(v)] != 0) continue;
            seen[static_cast<std::size_t>(v)] = 1;
            if ((mesh.vertices.col(v) - mesh.vertices.col(center)).norm() <= radius) patch.push_back(v);
        }
    return patch;
}

}  // namespace elastolab
