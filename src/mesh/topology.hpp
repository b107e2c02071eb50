#pragma once

#include <span>
#include <vector>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// For every vertex, the triangles around it, ascending (compressed rows).
class VertexTriangles {
public:
    explicit VertexTriangles(const SurfaceMesh& mesh);
    std::span<const int> operator[](int vertex) const {
        const auto v = static_cast<std::size_t>(vertex);
        return {triangles_.data() + offsets_[v], triangles_.data() + offsets_[v + 1]};
    }

private:
    std::vector<int> offsets_;
    std::vector<int> triangles_;
};

/// Corner c of triangle t, or the edge from its corner c to the next, written as one number 3 t + c.
inline int next_corner(int half_edge) { return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1; }

/// The undirected edges of a mesh, ascending by their vertices, each with the half-edges (3 * triangle + corner) that
/// run along it, ascending. An edge of a closed manifold has two, in opposite directions.
class EdgeTable {
public:
    struct Edge {
        int a = 0, b = 0;  ///< vertices, a <= b
    };

    explicit EdgeTable(const SurfaceMesh& mesh);
    int size() const { return static_cast<int>(edges_.size()); }
    Edge operator[](int edge) const { return edges_[static_cast<std::size_t>(edge)]; }
    std::span<const int> half_edges(int edge) const {
        const auto e = static_cast<std::size_t>(edge);
        return {half_edges_.data() + offsets_[e], half_edges_.data() + offsets_[e + 1]};
    }

private:
    std::vector<Edge> edges_;
    std::vector<int> offsets_;
    std::vector<int> half_edges_;
};

/// Connected surfaces: parts that share edges (a common vertex alone does not connect).
struct Components {
    int count = 0;
    std::vector<int> of_triangle;  ///< component of each triangle; components are numbered by their first triangle

    std::vector<std::vector<int>> triangles() const;  ///< of each component, ascending
};
Components connected_components(const SurfaceMesh& mesh, const EdgeTable& edges);

}  // namespace elastolab
