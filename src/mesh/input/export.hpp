#pragma once

#include <filesystem>
#include <iosfwd>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Writes OBJ (17 significant digits), PLY (binary, double precision) or STL (binary, single precision, as STL is), by
/// the file's extension. A file of that name is replaced only once the new one is complete. Throws MeshError for
/// another extension, Error when it cannot be written.
void save_surface(const std::filesystem::path& file, const SurfaceMesh& mesh);

/// The same onto a stream, in the format of a file of this name. Throws MeshError for another extension.
void write_surface(std::ostream& out, const SurfaceMesh& mesh, const std::filesystem::path& name);

}  // namespace elastolab
