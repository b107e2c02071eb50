#include "app/input/patch.hpp"

#include <algorithm>
#include <map>
#include <utility>

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

namespace {

double circumference(const SurfaceMesh& mesh, const Eigen::Vector3i& t) {
    const Positions& x = mesh.vertices;
    return (x.col(t[0]) - x.col(t[1])).norm() + (x.col(t[1]) - x.col(t[2])).norm() + (x.col(t[2]) - x.col(t[0])).norm();
}

/// A connected patch made of whole triangles: a vertex without one in the patch adds its smallest free triangle that
/// has another corner in it, or is dropped where there is none. The first vertex always stays first.
std::vector<int> with_whole_triangles(const SurfaceMesh& mesh, const std::vector<int>& patch,
                                      const std::function<bool(int)>& is_free) {
    enum State : char { outside, alone, whole };
    std::vector<State> states(static_cast<std::size_t>(mesh.n_vertices()), outside);
    const auto state = [&](int v) -> State& { return states[static_cast<std::size_t>(v)]; };
    for (const int v : patch) state(v) = alone;
    for (const auto& t : mesh.triangles.colwise())
        if (state(t[0]) != outside && state(t[1]) != outside && state(t[2]) != outside)
            for (const int v : t) state(v) = whole;
    std::map<int, std::pair<double, Eigen::Vector3i>> smallest;  // of vertices alone
    const std::ptrdiff_t n_inside = std::min<std::ptrdiff_t>(2, std::ssize(patch));
    for (const auto& t : mesh.triangles.colwise()) {
        if (std::count_if(t.begin(), t.end(), [&](int v) { return state(v) != outside; }) < n_inside) continue;
        if (!std::all_of(t.begin(), t.end(), is_free)) continue;
        for (const int v : t) {
            if (state(v) != alone) continue;
            const auto [found, is_new] = smallest.try_emplace(v, circumference(mesh, t), t);
            if (!is_new && circumference(mesh, t) < found->second.first) found->second = {circumference(mesh, t), t};
        }
    }
    std::vector<int> result = patch;
    for (const auto& [lone, found] : smallest)
        for (const int v : found.second) {
            if (state(v) == outside) result.push_back(v);
            state(v) = whole;
        }
    if (state(patch.front()) == whole) std::erase_if(result, [&](int v) { return state(v) != whole; });
    return state(patch.front()) == whole ? result : std::vector<int>{patch.front()};
}

}  // namespace

std::vector<int> patch_around(const SurfaceMesh& mesh, const VertexGraph& graph, int center, double radius,
                              const std::function<bool(int)>& is_free) {
    std::vector<int> patch = {center};
    std::vector<char> seen(static_cast<std::size_t>(mesh.n_vertices()), 0);
    seen[static_cast<std::size_t>(center)] = 1;
    for (std::size_t next = 0; next < patch.size(); ++next)
        for (const int v : graph[patch[next]]) {
            if (seen[static_cast<std::size_t>(v)] != 0) continue;
            seen[static_cast<std::size_t>(v)] = 1;
            if ((mesh.vertices.col(v) - mesh.vertices.col(center)).norm() <= radius) patch.push_back(v);
        }
    std::erase_if(patch, [&](int v) { return !is_free(v); });
    return radius > 0.0 ? with_whole_triangles(mesh, patch, is_free) : patch;
}

bool has_whole_triangle(const SurfaceMesh& surface, std::span<const int> vertices) {
    std::vector<char> is_one(static_cast<std::size_t>(surface.n_vertices()), 0);
    for (const int v : vertices)
        if (v < surface.n_vertices()) is_one[static_cast<std::size_t>(v)] = 1;
    for (const auto& triangle : surface.triangles.colwise())
        if (is_one[static_cast<std::size_t>(triangle[0])] != 0 && is_one[static_cast<std::size_t>(triangle[1])] != 0 &&
            is_one[static_cast<std::size_t>(triangle[2])] != 0)
            return true;
    return false;
}

std::vector<int> surface_vertices(const PickHit& hit, const Triangles& shown, int n_vertices) {
    if (hit.triangle < 0) return {hit.vertex};
    std::vector<int> corners(shown.col(hit.triangle).begin(), shown.col(hit.triangle).end());
    std::erase_if(corners, [&](int v) { return v >= n_vertices; });
    return corners;
}

}  // namespace elastolab
