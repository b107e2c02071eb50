#pragma once

#include <Eigen/Core>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Signed volume of one tetrahedron [L^3].
double tet_volume(const TetMesh& mesh, int tetrahedron);
/// Sum of all signed volumes [L^3].
double total_volume(const TetMesh& mesh);

/// Shape of the tetrahedra. A bad element costs accuracy near it and condition of the stiffness matrix.
struct TetQuality {
    double least_volume = 0.0;       ///< signed [L^3]
    double least_shape = 0.0;        ///< least 6 sqrt(2) volume / longest edge^3: 1 regular, 0 flat
    double least_dihedral = 0.0;     ///< smallest angle between faces [degrees]
    double greatest_dihedral = 0.0;  ///< largest [degrees]
};
TetQuality tet_quality(const TetMesh& mesh);

}  // namespace elastolab
