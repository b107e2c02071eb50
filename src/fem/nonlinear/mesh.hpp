#pragma once

#include <memory>
#include <vector>

#include "deform/element_degree.hpp"
#include "fem/constrained_nodes.hpp"
#include "fem/nonlinear/elements.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// What does not depend on the material: tetrahedra as elements of a degree, and as what the inside is shown by.
struct NonlinearMesh {
    /// Its vertices are the nodes, those of the surface first. Elements of ten nodes are split in eight.
    TetMesh tets;
    int n_surface_nodes = 0;
    SurfaceMidpoints midpoints;  ///< of ten nodes, else none
    Triangles surface;           ///< the surface as it was given, and the midpoints of its edges where there are any
    Triangles surface_midpoints;
    std::shared_ptr<const FiniteElements> elements;
    /// For ten nodes: the same tetrahedra with four, and the node of each of their vertices.
    std::shared_ptr<const FiniteElements> linear;
    std::vector<int> corner_nodes;

    int n_vertices() const { return tets.n_surface_vertices; }
};

std::shared_ptr<const NonlinearMesh> make_nonlinear_mesh(TetMesh tets, const Triangles& surface, ElementDegree degree);

}  // namespace elastolab
