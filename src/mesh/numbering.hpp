#pragma once

#include <Eigen/Core>
#include <vector>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// These numbers ascending, each once.
std::vector<int> each_once(std::vector<int> numbers);

/// The vertices that triangles or edges (one a column) use: ascending, each once.
std::vector<int> used_vertices(const Eigen::Ref<const Eigen::MatrixXi>& corners);

/// Vertex numbers become places in `vertices`, which is ascending and has them all.
void renumber(Eigen::Ref<Eigen::MatrixXi> corners, const std::vector<int>& vertices);

/// The mesh without the vertices that no triangle uses; the others keep their order.
SurfaceMesh without_unused(const SurfaceMesh& mesh);

}  // namespace elastolab
