#pragma once

#include <vector>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// One connected solid of a mesh: an outer surface and the surfaces of its cavities.
struct Solid {
    SurfaceMesh surface;
    std::vector<int> vertices;   ///< vertex of the whole mesh, for each vertex of `surface`, ascending
    std::vector<int> triangles;  ///< triangle of the whole mesh, for each triangle of `surface`, ascending
};

/// Splits a closed, consistently oriented mesh (mesh/checks/check.hpp) into its solids: every component that faces
/// outward begins one, every component that faces inward is a cavity of the innermost outward one around it.
std::vector<Solid> split_solids(const SurfaceMesh& mesh);

/// The part of a mesh with these triangles, as one.
Solid with_triangles(const SurfaceMesh& mesh, std::vector<int> triangles);

/// The point around which a solid with this surface is to be computed: the middle of its box, when that is farther from
/// the origin than four times the box's diagonal and its coordinates would cost digits; else the origin, so that
/// nothing is rounded.
Eigen::Vector3d computing_origin(const SurfaceMesh& surface);

/// The power of two by which a solid with this surface is to be multiplied for computing: its box's diagonal is in
/// [1, 2) then. Matrices hold entries of several physical dimensions, so that pivots, conditions and least-squares
/// solutions would depend on the unit of length; a power of two rounds nothing.
double computing_scale(const SurfaceMesh& surface);

}  // namespace elastolab
