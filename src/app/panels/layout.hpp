#pragma once

#include <Eigen/Core>
#include <vector>

#include "app/viewer_state.hpp"

namespace elastolab {

/// Where things are in the window [logical pixels].
struct Layout {
    Viewport menu, panel, scene, status;
};

/// For a window of this size and panels of this scale. In a window too small for both, the scene comes first.
/// `display`: whether there is a panel, and how wide it was made.
Layout layout_of(const Eigen::Vector2i& window, float scale, const DisplaySettings& display = {});

/// The viewports for what is compared, within the part of the window that shows the scene.
std::vector<SceneViewport> viewports_of(const ViewerState& state, const Viewport& scene);

}  // namespace elastolab
