#pragma once

#include <Eigen/Core>
#include <span>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Corners of one triangle.
struct TrianglePoints {
    Eigen::Vector3d a, b, c;
};
TrianglePoints triangle_points(const SurfaceMesh& mesh, int triangle);
Eigen::Vector3d centroid(const SurfaceMesh& mesh, int triangle);

/// Twice the area times the unit normal: (b - a) x (c - a)  [L^2].
Eigen::Vector3d area_vector(const TrianglePoints& triangle);

/// Mean length of the edges [L]; 0 when there are none.
double mean_edge(const SurfaceMesh& mesh);
/// Area of the surface [L^2].
double surface_area(const SurfaceMesh& mesh);

/// How long the way along the edges is between the two vertices of one connected surface that are farthest apart by it
/// [L], within some percent: the length of a body that is curved or wound. Found by going three times to the vertex
/// that is farthest away.
double length_along_surface(const SurfaceMesh& mesh);

/// Signed volume that these triangles enclose [L^3]: positive when they face outward. Right only for closed surfaces.
double enclosed_volume(const SurfaceMesh& mesh, std::span<const int> triangles);
double enclosed_volume(const SurfaceMesh& mesh);

/// How often these triangles, a closed surface, wind around a point that is not on them: the sum of their signed solid
/// angles over 4 pi. 1 inside an outward-facing surface, -1 inside an inward-facing one, 0 outside, to rounding.
/// Source: A. van Oosterom, J. Strackee, The solid angle of a plane triangle, IEEE Trans. Biomed. Eng. 30, 1983.
double winding_number(const SurfaceMesh& mesh, std::span<const int> triangles, const Eigen::Vector3d& point);

}  // namespace elastolab
