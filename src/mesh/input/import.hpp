#pragma once

#include <filesystem>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Reads a triangle mesh from any format that assimp reads (OBJ, PLY, STL, OFF, glTF, ...): all meshes of the scene in
/// world coordinates, polygons triangulated, points and lines ignored, vertices at exactly equal places merged (-0
/// equals 0), vertices that no triangle uses dropped. Does not judge the result: check_and_repair() does, and also
/// reports coordinates that are not finite. Vertices are numbered in the order of first appearance in the file: of the
/// vertex list for OBJ, PLY and OFF, of the triangles' corners for STL, of the meshes in the order of the scene's nodes
/// for formats that have such. assimp keeps coordinates as 32-bit floats, about 7 digits; equality means equality of
/// these. Throws MeshError when the file is missing, a directory, empty, not readable or damaged, or holds no triangle.
SurfaceMesh load_surface(const std::filesystem::path& file);

}  // namespace elastolab
