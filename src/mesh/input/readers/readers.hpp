#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Why a mesh file is refused, and what to do about it: the words after "file.obj: ".
class Refusal : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

[[noreturn]] inline void refuse_damaged(const std::string& finding) {
    throw Refusal(finding + " Is it damaged? Export it again.");
}

// Readers of mesh files, for the helper program only. Each takes all bytes of a file and gives its vertices in the
// file's order (for STL: of the triangles' corners) and its polygons as triangles; points and lines are left out.
// Decimal numbers become the nearest double, binary ones stay what they are: no digit is lost. A file is read in full
// or refused: its counts must agree with what it holds.

/// Statements v and f; all others are ignored, but free-form surfaces refused. Lines may be continued by '\'. Indices
/// may be negative (counted from the last vertex so far). `v x y z w` is divided by w; with six or seven numbers, those
/// after the third are a colour.
SurfaceMesh read_obj(std::string_view bytes);

/// Text or binary of either byte order; polygons (element "face") and triangle strips (element "tristrips"); further
/// elements and properties are skipped. Text of properties declared "float" keeps its digits, too.
SurfaceMesh read_ply(std::string_view bytes);

/// Text. Headers [ST][C][N][4][n]OFF: normals, colours and texture coordinates are skipped, 4-vectors divided by their
/// last component. A stream of words: faces may run over several lines; words that follow a face on its line are its
/// colour.
SurfaceMesh read_off(std::string_view bytes);

/// Text or binary, told apart by the size of the file.
SurfaceMesh read_stl(std::string_view bytes);
/// Whether the size of the file is that which its 80 bytes of anything and its number of facets demand.
bool is_binary_stl(std::string_view bytes);

/// All other formats, by assimp: all meshes of the scene in world coordinates. Coordinates are single precision.
SurfaceMesh read_scene(const std::filesystem::path& file);

}  // namespace elastolab
