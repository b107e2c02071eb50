#pragma once

#include <Eigen/Core>
#include <vector>

#include "mesh/surface_mesh.hpp"

namespace elastolab::test {

/// A box [0, size] of cells[0] x cells[1] x cells[2] cells, six tetrahedra each (all share a diagonal of the cell), so
/// that tests need no mesher. Surface vertices come first.
/// jitter  moves every vertex by up to this fraction of a cell, at random (seeded), within the faces and edges it lies
///         on; below about 0.2 all tetrahedra stay positive.
TetMesh make_tet_box(const Eigen::Vector3i& cells, const Eigen::Vector3d& size, double jitter = 0.0);

/// Boundary triangles of a tetrahedral mesh, outward, over its surface vertices.
SurfaceMesh boundary(const TetMesh& mesh);

/// Vertices among the first n that satisfy a predicate on their position.
template <class Predicate>
std::vector<int> vertices_where(const Positions& positions, int n, Predicate&& predicate) {
    std::vector<int> found;
    for (int v = 0; v < n; ++v)
        if (predicate(Eigen::Vector3d(positions.col(v)))) found.push_back(v);
    return found;
}

}  // namespace elastolab::test
