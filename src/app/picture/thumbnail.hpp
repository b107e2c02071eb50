#pragma once

#include <filesystem>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Pixels along an edge of a thumbnail.
inline constexpr int kSmallestThumbnail = 16, kLargestThumbnail = 2048;

/// A small picture of a surface for file managers, without a display: seen slantwise from above, fitted into a square
/// of `size` pixels on a transparent ground. Replaces `file` (PNG) once it is complete. Throws Error.
void write_thumbnail(const std::filesystem::path& file, const SurfaceMesh& surface, int size);

}  // namespace elastolab
