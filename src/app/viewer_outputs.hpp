#pragma once

#include <optional>

#include "app/viewer.hpp"
#include "app/viewer_state.hpp"
#include "render/gl/image.hpp"

namespace elastolab {

/// Writes what `options` ask for at the end of a session: the scene, the deformed mesh, timings, the interaction, and
/// `picture` as the screenshot. Each is written whatever becomes of the others. Throws the first failure.
void write_outputs(const ViewerOptions& options, ViewerState& state, const std::optional<Image>& picture);

}  // namespace elastolab
