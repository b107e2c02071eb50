#pragma once

#include <filesystem>

#include "scene/constraints.hpp"

namespace elastolab {

/// Throws SceneError that names /gravity or /loads when loads on a solid of this surface do not balance though its
/// constraints leave it free to move. Handles that move by a force do not hold it, and their forces count.
void require_balance(const Document& document, const Constraints& constraints, const SurfaceMesh& surface,
                     const std::filesystem::path& scene_file);

/// Whether the constrained vertices move as a rigid body does (by a small rotation) and nothing loads it, so that exact
/// reactions are zero and those of an answer are rounding. surface: what the set is on.
bool moves_rigidly(const Constraints& constraints, const SurfaceMesh& surface);

}  // namespace elastolab
