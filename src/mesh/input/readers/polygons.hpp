#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <span>
#include <vector>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// A surface of polygons, as a file has it.
struct PolygonMesh {
    std::vector<Eigen::Vector3d> vertices;
    std::vector<int> corners;       ///< vertices of all polygons, one polygon after another
    std::vector<std::size_t> ends;  ///< of each polygon, one past its last place in `corners`
    int first_number = 0;           ///< what the file calls its first vertex

    void close_polygon() { ends.push_back(corners.size()); }
};

/// Number of a vertex as an int. Throws Refusal when it is not one of these: `index` counts from 0, the file from
/// first_number.
int checked_index(std::int64_t index, std::size_t n_vertices, int first_number = 0);

/// Cuts polygons into triangles, in order; what has less than three corners is left out. Throws Refusal when a corner
/// is no vertex, or the mesh is too large for this program.
SurfaceMesh triangulated(const PolygonMesh& mesh);

/// Cuts one polygon, not necessarily flat or convex, into triangles with its orientation: n - 2 of them, if no two
/// neighbouring corners are at the same place (those count once). A polygon that crosses itself when seen from its side
/// gives triangles that overlap.
///   corners  vertices of the polygon, counter-clockwise
///   triangles  where the triangles are appended
void triangulate(std::span<const int> corners, const std::vector<Eigen::Vector3d>& vertices,
                 std::vector<Eigen::Vector3i>& triangles);

}  // namespace elastolab
