#pragma once

#include <Eigen/Core>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// A plane through the rest shape.
struct SectionPlane {
    int axis = 0;             ///< 0, 1, 2: its normal
    double coordinate = 0.0;  ///< along the axis [L]
    bool flip = false;        ///< keeps what is above instead of what is below
    bool operator==(const SectionPlane&) const = default;
};

/// The faces of all tetrahedra with their centre on the kept side that belong to no other of these: whole tetrahedra
/// show, as they are. Counter-clockwise seen from outside.
Triangles cut_faces(const TetMesh& mesh, const SectionPlane& plane);

}  // namespace elastolab
