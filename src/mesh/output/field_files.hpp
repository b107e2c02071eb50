#pragma once

#include <filesystem>
#include <iosfwd>
#include <span>

#include "mesh/output/mesh_field.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// VTK's XML format for polygons, as ParaView reads it: little endian, double precision, base64. Fields have a column
/// for each vertex.
void write_vtp(std::ostream& out, const SurfaceMesh& mesh, std::span<const MeshField> at_vertices);

/// The same for tetrahedra; fields at the vertices, and in the cells (a column for each tetrahedron).
void write_vtu(std::ostream& out, const TetMesh& mesh, std::span<const MeshField> at_vertices,
               std::span<const MeshField> in_cells);

/// Binary PLY, little endian and in double precision, with a property for each component of the fields.
void write_ply(std::ostream& out, const SurfaceMesh& mesh, std::span<const MeshField> at_vertices);

/// "vertex,x,y,z," and then every component of the fields: a row for each vertex, 17 significant digits.
void write_field_csv(std::ostream& out, const Positions& vertices, std::span<const MeshField> at_vertices);

}  // namespace elastolab
