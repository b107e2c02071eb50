#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <iosfwd>
#include <span>
#include <string>

#include "mesh/output/mesh_field.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Which vector field VTK and ParaView take for the displacement of the points (Warp By Vector): where the points are
/// at rest, the first one of three components; none where they have moved already.
enum class VtkPoints { at_rest, moved };

/// VTK's XML format for polygons, as ParaView reads it: little endian, double precision, base64. Fields have a column
/// for each vertex and, in the file, names of their components (X, XX ...). The field data have the facts and the unit
/// of each field ("unit_of_displacement").
void write_vtp(std::ostream& out, const SurfaceMesh& mesh, std::span<const MeshField> at_vertices,
               const FileFacts& facts = {}, VtkPoints points = VtkPoints::at_rest);

/// The same for tetrahedra; fields at the vertices, and in the cells (a column for each tetrahedron).
/// cells: vertex numbers, 4 x n, or 10 x n with the midpoints of the edges 01 02 03 12 13 23 behind the corners; in the
/// file they have VTK's order, 01 12 02 03 13 23.
void write_vtu(std::ostream& out, const Positions& vertices, const Eigen::MatrixXi& cells,
               std::span<const MeshField> at_vertices, std::span<const MeshField> in_cells, const FileFacts& facts = {},
               VtkPoints points = VtkPoints::at_rest);

/// One file of a series.
struct SeriesStep {
    double time = 0.0;
    std::string file;  ///< relative to the folder of the series
};
/// ParaView's list of the files of a series (.pvd).
void write_pvd(std::ostream& out, std::span<const SeriesStep> steps);

/// Binary PLY, little endian and in double precision, with a property for each component of the fields.
void write_ply(std::ostream& out, const SurfaceMesh& mesh, std::span<const MeshField> at_vertices);

/// "vertex,x,y,z," and then every component of the fields: a row for each vertex, 17 significant digits.
void write_field_csv(std::ostream& out, const Positions& vertices, std::span<const MeshField> at_vertices);

}  // namespace elastolab
