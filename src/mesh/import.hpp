#pragma once

#include <filesystem>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Reads a triangle mesh from any format that assimp reads (OBJ, PLY, STL, OFF, glTF, ...): all meshes of the scene in
/// world coordinates, polygons triangulated, vertices at exactly equal places merged in order of first appearance,
/// vertices that no triangle uses dropped. Does not judge the result; that is mesh/check.hpp.
/// Throws MeshError when the file is missing, a directory, empty, not readable, or holds no triangle.
SurfaceMesh load_surface(const std::filesystem::path& file);

}  // namespace elastolab
