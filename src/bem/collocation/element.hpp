#pragma once

#include <memory>
#include <span>
#include <vector>

#include "bem/boundary.hpp"
#include "bem/collocation/traction_space.hpp"
#include "deform/constraint_map.hpp"

namespace elastolab {

/// A constrained set in terms of nodes and tractions.
struct BemConstraints {
    ConstrainedNodes nodes;
    TractionSpace space;
    int n_fixed = 0;  ///< the first so many nodes rest
};

/// What a collocation method puts on a triangle: where its nodes are, which shape functions carry displacements and
/// tractions, how constrained vertices act on nodes and how nodes show at vertices. Stateless.
class BoundaryElement {
public:
    virtual ~BoundaryElement() = default;

    /// Collocation points, one for each node.
    virtual CollocationPoints nodes(const Boundary& boundary) const = 0;
    /// Shape functions of the displacements over the whole surface; slot = node.
    virtual Elements shape_functions(const Boundary& boundary) const = 0;
    /// Whether one K = G^-1 H serves every constrained set: the tractions are carried by the shape functions of the
    /// displacements.
    virtual bool has_stiffness(Tractions tractions) const = 0;
    virtual BemConstraints constrain(const Boundary& boundary, const VertexTriangles& triangles_of_vertex,
                                     Tractions tractions, std::span<const int> fixed,
                                     std::span<const int> handles) const = 0;
    /// What takes displacements of nodes to those of vertices, 3*n_vertices x 3*n_nodes; null where they are the same.
    virtual std::shared_ptr<const SparseRows> display(const SurfaceMesh& mesh,
                                                      const VertexTriangles& triangles_of_vertex) const = 0;
};

/// A node at the centroid of each triangle, displacement and traction constant on it. A vertex is shown at the mean of
/// the triangles around it.
const BoundaryElement& constant_element();
/// A node at each vertex, displacements linear on each triangle; tractions as Method::tractions says.
const BoundaryElement& linear_element();

}  // namespace elastolab
