#pragma once

#include <Eigen/Core>
#include <vector>

#include "app/viewer_state.hpp"

namespace elastolab {

/// Where things are in the window [logical pixels].
struct Layout {
    Viewport menu, panel, scene, status;
};

/// Heights from which a side panel has room for more than what is used most, and for what is selected as well [logical
/// pixels].
inline constexpr double kTallPanel = 840.0, kVeryTallPanel = 940.0;
/// Whether the headings of all sections would not fit beside what is used most.
bool is_short(const Layout& layout, double scale);
bool is_very_tall(const Layout& layout, double scale);  ///< from kVeryTallPanel on

/// For a window of this size and panels of this scale. In a window too small for both, the scene comes first.
/// `display`: whether there is a panel, and how wide it was made.
Layout layout_of(const Eigen::Vector2i& window, float scale, const DisplaySettings& display = {});

/// Width of the legend's heading, which takes as many lines as it needs [pixels at scale 1].
constexpr double kLegendHeadingWidth = 104.0;

/// The viewports for what is compared, within the part of the window that shows the scene: up to three in a row, more
/// in two rows. When a field is shown, those at the right are wider by what its legend covers. `scale`: of the legend.
std::vector<SceneViewport> viewports_of(const ViewerState& state, const Viewport& scene, double scale = 1.0);

}  // namespace elastolab
