#pragma once

#include <ostream>
#include <vector>

#include "mesh/surface_mesh.hpp"
#include "scene/solve.hpp"

namespace elastolab {

/// "vertex,x,y,z,ux,uy,uz": rest positions and displacements [L], 17 significant digits, a row for each vertex.
void write_displacements(std::ostream& out, const SurfaceMesh& mesh, const Eigen::Matrix3Xd& displacement);

/// "name,fx,fy,fz,mx,my,mz": a row for each group, forces [force] and moments [force * L], 17 significant digits. A
/// name with a comma, a quote or a line break is quoted (RFC 4180).
void write_forces(std::ostream& out, const std::vector<GroupReaction>& reactions);

}  // namespace elastolab
