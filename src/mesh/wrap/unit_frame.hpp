#pragma once

#include <Eigen/Core>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// x = scale y + centre takes a body of size 1 around the origin back to its place: geometric libraries have absolute
/// thresholds.
struct UnitFrame {
    Eigen::Vector3d centre;
    double scale;
};

/// Brings the triangles of a mesh to size 1. Throws MeshError when all are in one point.
UnitFrame to_unit_size(SurfaceMesh& mesh);

}  // namespace elastolab
