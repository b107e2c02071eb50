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

}  // namespace elastolab
