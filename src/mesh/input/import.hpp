#pragma once

#include <filesystem>
#include <string>

#include "base/control.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// A surface as a file has it, and what its user should know of it.
struct ImportedSurface {
    SurfaceMesh mesh;
    std::string warning;  ///< when coordinates are coarse for the body's size; empty else
};

/// Reads a triangle mesh: OBJ, PLY, OFF and STL with every digit of the file, and the other formats of
/// mesh/input/formats.hpp by assimp, which keeps coordinates as 32-bit floats, about 7 digits. All meshes of a scene in
/// world coordinates, polygons triangulated, points and lines ignored, vertices at exactly equal places merged (-0
/// equals 0), vertices that no triangle uses dropped. Does not judge the result; that is mesh/checks/check.hpp, which
/// also reports coordinates that are not finite. Vertices are numbered in the order of first appearance in the file: of
/// the vertex list for OBJ, PLY and OFF, of the triangles' corners for STL, of the meshes in the order of the scene's
/// nodes for formats that have such. A file is read in full or refused: throws MeshError when it is missing, a folder,
/// empty, of another format, not readable, damaged, cut short, or holds no triangle. Other files that it names are read
/// in its folder and below only. A cancel of `control` ends the reader within 20 ms: throws Cancelled.
ImportedSurface import_surface(const std::filesystem::path& file, Control& control);

/// The mesh alone, for callers that never cancel.
SurfaceMesh load_surface(const std::filesystem::path& file);

}  // namespace elastolab
