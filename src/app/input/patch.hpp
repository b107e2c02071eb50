#pragma once

#include <functional>
#include <span>
#include <vector>

#include "mesh/surface_mesh.hpp"
#include "render/geometry/picking.hpp"

namespace elastolab {

/// Neighbours of every vertex along edges, for walks over a surface.
class VertexGraph {
public:
    explicit VertexGraph(const SurfaceMesh& mesh);
    std::span<const int> operator[](int vertex) const;

private:
    std::vector<int> offsets_, neighbours_;
};

/// Vertices around `center` (first in the list): those within `radius` [L] of it that can be reached over others of
/// them, so that a patch does not jump to the other side of a thin part; of these only the free ones. Where the radius
/// is not 0, only corners of whole triangles: a lone vertex is a point load, whose answer depends on the mesh. A vertex
/// that has none adds a triangle that it shares with the patch, even beyond the radius, or is left out where none is
/// free. `center` must be free. Rest positions.
std::vector<int> patch_around(const SurfaceMesh& mesh, const VertexGraph& graph, int center, double radius,
                              const std::function<bool(int)>& is_free);

/// Whether some triangle has all its corners among these vertices of the surface; others are none of it.
bool has_whole_triangle(const SurfaceMesh& surface, std::span<const int> vertices);

/// Vertices of the surface where it was hit. A triangle that is cut has corners that are none.
std::vector<int> surface_vertices(const PickHit& hit, const Triangles& shown, int n_vertices);

}  // namespace elastolab
