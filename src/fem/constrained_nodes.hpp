#pragma once

#include <span>
#include <vector>

#include "deform/constraint_map.hpp"
#include "deform/load_share.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// The midpoints of a surface's edges among the nodes; none for linear elements.
struct SurfaceMidpoints {
    Triangles triangles;  ///< vertices
    Triangles midpoints;  ///< the nodes between its vertices 0 and 1, 1 and 2, 2 and 0
};

/// The nodes that a constrained set prescribes, and which vertices carry their forces.
struct ConstrainedFemNodes {
    ConstrainedNodes prescribed;  ///< those of the fixed set first
    int n_fixed = 0;
    std::vector<LoadShare> shares;
    std::vector<int> vertices;  ///< constrained: the fixed set, then the handles

    std::span<const int> fixed() const { return std::span(prescribed.nodes).first(static_cast<std::size_t>(n_fixed)); }
};

/// Displacements are linear on a triangle whose three vertices are constrained: the midpoints of its edges are
/// prescribed at the mean of their ends. A constrained vertex without such a triangle prescribes itself only. Forces
/// are the energy's derivatives with respect to the displacements of the vertices, so that each end of an edge carries
/// half of the force at its midpoint.
/// positions       of all nodes, vertices of the surface first
/// fixed, handles   vertices of the surface, all different
ConstrainedFemNodes constrain_nodes(const Positions& positions, const SurfaceMidpoints& surface,
                                    std::span<const int> fixed, std::span<const int> handles);

}  // namespace elastolab
