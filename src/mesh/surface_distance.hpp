#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Distance of a point from a triangle [L].
double distance_to_triangle(const Eigen::Vector3d& point, const SurfaceMesh& mesh, int triangle);

/// Where the two sides of a wall, or of a gap, come closest.
struct Approach {
    double ratio = std::numeric_limits<double>::infinity();  ///< distance / longest edge of the triangle opposite
    int vertex = -1;
};
/// The closest approach of any vertex to a triangle that does not contain it and faces the opposite way (normals more
/// than 120 degrees apart), if closer than an edge. Compares all pairs: a fraction of an assembly.
Approach closest_facing_approach(const SurfaceMesh& mesh);

/// Two parts of a mesh that come closer than `distance`, and a vertex there.
struct Contact {
    std::size_t first, second;
    int vertex;
};
/// The first such pair, vertices of one against triangles of the other. parts: the vertices of each.
std::optional<Contact> find_contact(const SurfaceMesh& mesh, std::span<const std::vector<int>> parts, double distance);

}  // namespace elastolab
