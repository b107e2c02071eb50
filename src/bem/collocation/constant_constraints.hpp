#pragma once

#include <span>

#include "deform/constraint_map.hpp"
#include "mesh/surface_mesh.hpp"
#include "mesh/topology.hpp"

namespace elastolab {

/// Constant elements: a triangle is constrained when all its vertices are, at the mean of their displacements; a vertex
/// with no such triangle constrains the triangles around it, at the mean over the vertices of this kind that the
/// triangle has.
ConstrainedNodes constrain_triangles(const SurfaceMesh& mesh, const VertexTriangles& triangles_of_vertex,
                                     std::span<const int> vertices);

/// Constant elements show a vertex at the mean of the triangles around it: 3*n_vertices x 3*n_triangles.
SparseRows average_of_triangles(const SurfaceMesh& mesh, const VertexTriangles& triangles_of_vertex);

}  // namespace elastolab
