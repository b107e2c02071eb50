#include "mesh/topology.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

namespace elastolab {

VertexTriangles::VertexTriangles(const SurfaceMesh& mesh)
    : offsets_(static_cast<std::size_t>(mesh.n_vertices()) + 1, 0),
      triangles_(static_cast<std::size_t>(mesh.triangles.size())) {
    const auto corners = mesh.triangles.reshaped();
    for (const int v : corners) ++offsets_[static_cast<std::size_t>(v) + 1];
    std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
    std::vector<int> cursor(offsets_.begin(), offsets_.end() - 1);
    for (Eigen::Index corner = 0; corner < corners.size(); ++corner) {
        int& slot = cursor[static_cast<std::size_t>(corners[corner])];
        triangles_[static_cast<std::size_t>(slot++)] = static_cast<int>(corner / 3);
    }
}

namespace {

struct EdgeUse {
    std::uint64_t key;  // both vertices, the smaller one in the upper half
    int half_edge;
    auto operator<=>(const EdgeUse&) const = default;  // NOLINT(modernize-use-nullptr): of clang-tidy 14
};

std::vector<EdgeUse> sorted_edge_uses(const SurfaceMesh& mesh) {
    const auto corners = mesh.triangles.reshaped();
    std::vector<EdgeUse> uses(static_cast<std::size_t>(corners.size()));
    for (int h = 0; h < static_cast<int>(corners.size()); ++h) {
        const auto [a, b] = std::minmax({corners[h], corners[next_corner(h)]});
        uses[static_cast<std::size_t>(h)] = {static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint32_t>(b), h};
    }
    std::sort(uses.begin(), uses.end());
    return uses;
}

}  // namespace

EdgeTable::EdgeTable(const SurfaceMesh& mesh) {
    const std::vector<EdgeUse> uses = sorted_edge_uses(mesh);
    half_edges_.reserve(uses.size());
    for (std::size_t i = 0; i < uses.size(); ++i) {
        if (i == 0 || uses[i].key != uses[i - 1].key) {
            edges_.push_back({static_cast<int>(uses[i].key >> 32), static_cast<int>(uses[i].key & 0xffffffffu)});
            offsets_.push_back(static_cast<int>(i));
        }
        half_edges_.push_back(uses[i].half_edge);
    }
    offsets_.push_back(static_cast<int>(uses.size()));
}

std::vector<std::vector<int>> Components::triangles() const {
    std::vector<std::vector<int>> result(static_cast<std::size_t>(count));
    for (std::size_t t = 0; t < of_triangle.size(); ++t)
        result[static_cast<std::size_t>(of_triangle[t])].push_back(static_cast<int>(t));
    return result;
}

namespace {

/// Sets of triangles that are merged pair by pair; the smallest triangle represents its set.
class DisjointSets {
public:
    explicit DisjointSets(int n) : parent_(static_cast<std::size_t>(n)) {
        std::iota(parent_.begin(), parent_.end(), 0);
    }
    int find(int i) {
        while (parent(i) != i) i = parent(i) = parent(parent(i));
        return i;
    }
    void merge(int i, int j) {
        const auto [low, high] = std::minmax({find(i), find(j)});
        parent(high) = low;
    }

private:
    int& parent(int i) { return parent_[static_cast<std::size_t>(i)]; }
    std::vector<int> parent_;
};

}  // namespace

Components connected_components(const SurfaceMesh& mesh, const EdgeTable& edges) {
    DisjointSets sets(mesh.n_triangles());
    for (int e = 0; e < edges.size(); ++e)
        for (const int h : edges.half_edges(e)) sets.merge(h / 3, edges.half_edges(e).front() / 3);
    Components components{0, std::vector<int>(static_cast<std::size_t>(mesh.n_triangles()))};
    for (int t = 0; t < mesh.n_triangles(); ++t) {
        const int first = sets.find(t);
        components.of_triangle[static_cast<std::size_t>(t)] =
            first == t ? components.count++ : components.of_triangle[static_cast<std::size_t>(first)];
    }
    return components;
}

}  // namespace elastolab
