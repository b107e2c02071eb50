#pragma once

#include <Eigen/Core>
#include <vector>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Part of a body's height that it stands on, and by which a bare mesh is held.
inline constexpr double kFeet = 0.06;

/// The vertices of the lowest part of a body: up to `part` of its height.
std::vector<int> lowest_vertices(const SurfaceMesh& mesh, const Eigen::Vector3d& up, double part);

/// By which a bare mesh is held: its lowest part or, of a flat one that lies down, an end of its longest side.
std::vector<int> first_held_vertices(const SurfaceMesh& mesh, const Eigen::Vector3d& up);

/// The axis of a bare mesh that points up: Y, as most modelling programs have it, or Z where the body stands on its
/// lowest part along Z and would fall over along Y.
Eigen::Vector3d up_axis_of(const SurfaceMesh& mesh);

}  // namespace elastolab
