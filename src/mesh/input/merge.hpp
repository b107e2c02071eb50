#pragma once

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// The mesh with vertices at exactly equal places made one (-0 equals 0; equal patterns of not-a-number, too), numbered
/// in the order in which places first appear in mesh.vertices. Places that no triangle uses are dropped.
SurfaceMesh merged(const SurfaceMesh& mesh);

}  // namespace elastolab
