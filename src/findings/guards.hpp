#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

// What a method does badly, found before anybody believes its result, in words and with a way forward. The limits come
// from measurements that the functions name; tests/deform/guards_test.cpp repeats them.

/// Linear tetrahedra lock as Poisson's ratio nears 1/2: from 0.48 on their error in the bending of a bar is more than
/// twice that at 0.3; 3 times at 0.49, 9 times at 0.499, 29 times (a tenth of the displacement) at 0.4999.
std::vector<std::string> warn_of_locking(double poisson_ratio);

/// A system of this condition number (1-norm): displacements may be off by condition * 2e-16 of their size; from 1e-6
/// on that is told. `what` begins the message.
std::vector<std::string> warn_of_condition(const std::string& what, double condition);

/// Boundary elements: triangles so thin (altitude / longest edge below 5e-5) that their integrals keep fewer than six
/// digits, and walls or gaps thinner than half the edges beside them: a plate of 8 x 8 cells in bending is
/// 5 to 10 % off by linear elements and 40 % by constant ones from there on down; and bodies more than 15 times as long
/// as thick (4 volume / area): bars of two cells across in bending are 9 % off at 20 times, 15 % at 40 times.
std::vector<std::string> warn_of_surface(const SurfaceMesh& surface, bool constant);

/// Solids that come closer than a hundredth of an edge, and yet are separate bodies. parts: the vertices of each solid
/// in the mesh.
std::vector<std::string> warn_of_contact(const SurfaceMesh& surface, std::span<const std::vector<int>> parts);

/// Constrained vertices without a triangle whose vertices are all constrained: point constraints, whose response
/// depends on the size of the mesh; and a solid held almost only along a line. `solid`: its vertices in the mesh;
/// `constrained`: those of them that are.
std::vector<std::string> warn_of_point_constraints(const SurfaceMesh& surface, std::span<const int> constrained);
std::vector<std::string> warn_of_weak_hold(const SurfaceMesh& surface, std::span<const int> solid,
                                           std::span<const int> constrained);

}  // namespace elastolab
