#pragma once

#include <Eigen/Core>
#include <span>

#include "deform/unit_load.hpp"
#include "fem/quadratic_mesh.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

struct FemMesh;

/// Consistent nodal forces of unit loads: 3*n_nodes x loads.size() [force, per unit of each factor]. A body force on a
/// tetrahedron: V/4 at each of four nodes; of ten, -V/20 at the corners and V/5 at the midpoints. A traction on a
/// triangle: A/3 at each of three nodes; of six, 0 at the corners and A/3 at the midpoints. So nodal forces have the
/// resultant of the load but for rounding.
Eigen::MatrixXd load_vectors(const FemMesh& mesh, std::span<const UnitLoad> loads);
/// The same for quadratic elements on the tetrahedra of a linear mesh.
Eigen::MatrixXd load_vectors(const QuadraticMesh& mesh, const FemMesh& linear, std::span<const UnitLoad> loads);

/// The same; surface: triangles of the mesh's surface, in the order by which the loads number them.
Eigen::MatrixXd load_vectors(const QuadraticMesh& mesh, const Triangles& surface, std::span<const UnitLoad> loads);

/// The same; elements: their nodes, 4 or 10 rows; midpoints: of the surface's triangles, none for four nodes.
Eigen::MatrixXd load_vectors(const Positions& positions, const Eigen::MatrixXi& elements, const Triangles& surface,
                             const Triangles& midpoints, std::span<const UnitLoad> loads);

/// The midpoints of the edges of these triangles (vertex numbers), in the order of SurfaceMidpoints.
Triangles midpoints_of(const Triangles& triangles, const QuadraticMesh& mesh);

}  // namespace elastolab
