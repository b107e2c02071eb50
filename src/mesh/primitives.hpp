#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Closed, outward-oriented surface meshes made in code. `cells` >= 1 counts cells along the shortest edge (boxes) or
/// around a quarter turn (the others).

/// Spans [0, size]; a cube has 6 cells^2 + 2 vertices. Longer edges have proportionally more cells, rounded. Diagonals
/// alternate, so that no direction is preferred.
SurfaceMesh make_box(int cells, const Eigen::Vector3d& size = Eigen::Vector3d::Ones());
/// Centred at the origin, subdivided octahedron (4 cells^2 + 2 vertices); all vertices on the sphere.
SurfaceMesh make_sphere(int cells, double radius = 1.0);
/// Centred at the origin, axis z, flat caps of concentric rings.
SurfaceMesh make_cylinder(int cells, double radius = 0.5, double height = 2.0);
/// Centred at the origin, axis z; 4 * `cells` around the ring, and as many around the tube as make them square.
SurfaceMesh make_torus(int cells, double ring_radius = 1.0, double tube_radius = 0.35);
/// Two concentric spheres; the inner one faces inward (a cavity).
SurfaceMesh make_hollow_sphere(int cells, double outer_radius = 1.0, double inner_radius = 0.5);

/// The primitives by the names that scene files use ("cube", "box", "sphere", "cylinder", "torus", "beam",
/// "hollow-sphere"). `size`: empty for the defaults, else as many numbers as the primitive has lengths.
/// Throws MeshError for an unknown name, a resolution below 1, or sizes that are not positive or too many.
SurfaceMesh make_primitive(const std::string& name, int cells, const std::vector<double>& size = {});
std::vector<std::string> primitive_names();

}  // namespace elastolab
