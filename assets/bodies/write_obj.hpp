#pragma once

#include <filesystem>

#include "mesh/surface_mesh.hpp"

namespace elastolab::bodies {

/// Text with no more digits than the places have, 5 decimals. Throws std::runtime_error when it cannot be written.
void write_obj(const std::filesystem::path& file, const SurfaceMesh& mesh);

}  // namespace elastolab::bodies
