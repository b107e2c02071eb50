#pragma once

#include <filesystem>

#include "scene/constraints.hpp"

namespace elastolab {

/// Throws SceneError that names /gravity or /loads when loads on a solid of this surface do not balance though its
/// constraints leave it free to move. Handles that move by a force do not hold it, and their forces count.
void require_balance(const Document& document, const Constraints& constraints, const SurfaceMesh& surface,
                     const std::filesystem::path& scene_file);

}  // namespace elastolab
