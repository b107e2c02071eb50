#pragma once

#include <Eigen/Core>
#include <memory>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// The inside of one solid, of methods that have nodes there.
struct Interior {
    /// On all nodes, the surface vertices first, in the order of the solid; elements of second degree are split in
    /// eight.
    std::shared_ptr<const TetMesh> tetrahedra;
    /// On the same nodes. 4 x n; or 10 x n, of second degree: the corners, then the midpoints of the edges 01 02 03 12
    /// 13 23.
    Eigen::MatrixXi elements;
};

}  // namespace elastolab
