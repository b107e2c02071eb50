#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/control.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Distance of a point from a triangle [L].
double distance_to_triangle(const Eigen::Vector3d& point, const SurfaceMesh& mesh, int triangle);

/// Where the two sides of a wall, or of a gap, come closest.
struct FacingApproach {
    double ratio = std::numeric_limits<double>::infinity();  ///< distance / longest edge of the triangle opposite
    int vertex = -1;
};
/// Over all vertices and those triangles that do not have the vertex as a corner, face the opposite way (normals at
/// least 120 degrees apart) and are closer than their longest edge; none: infinity. Of several vertices, the first. A
/// search in a tree of boxes on all threads: with triangles of similar size about n log n steps. `control` learns the
/// progress of the present stage. Throws Cancelled.
FacingApproach closest_facing_approach(const SurfaceMesh& mesh, Control& control);
FacingApproach closest_facing_approach(const SurfaceMesh& mesh);

/// For every vertex the distance to the nearest triangle on the other side of its wall: one that faces the opposite way
/// and lies behind the vertex, the outside being in front [L]; infinite where none is within `reach`. Throws Cancelled.
std::vector<double> wall_thickness(const SurfaceMesh& mesh, double reach, Control& control);

/// Two parts of a mesh that come closer than `distance`, and a vertex there.
struct Contact {
    std::size_t first, second;
    int vertex;
};
/// The first such pair, vertices of one against triangles of the other: the first triangle, then the first part, then
/// its first vertex. parts: the vertices of each; a vertex is in one part at most, a triangle's are in the same.
/// Searches as closest_facing_approach() does. Throws Cancelled.
std::optional<Contact> find_contact(const SurfaceMesh& mesh, std::span<const std::vector<int>> parts, double distance,
                                    Control& control);
std::optional<Contact> find_contact(const SurfaceMesh& mesh, std::span<const std::vector<int>> parts, double distance);

}  // namespace elastolab
