#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>

#include "app/picture/palette.hpp"
#include "app/picture/picture_legend.hpp"
#include "app/picture/scene_renderer.hpp"
#include "app/viewer_state.hpp"
#include "render/gl/image.hpp"

namespace elastolab {

/// The scene as its viewports show it, without panels and axes, at another size [pixels]: lines and points grow with
/// it, and where the picture is narrower than the viewports the camera steps back until their width is in it. Drawn in
/// tiles of at most `largest_tile` pixels, so that the size is bounded by the driver's largest viewport only. What
/// renderer.upload() has handed over is drawn. Throws Error for a size that the driver refuses.
Image scene_picture(SceneRenderer& renderer, ViewerState& state, const Palette& palette, const Eigen::Vector2i& size,
                    int largest_tile = 4096);

struct PictureOptions {
    bool transparent = false;             ///< without background and grid
    std::optional<PictureLegend> legend;  ///< drawn over it
};
/// Writes one as PNG. Throws Error.
void write_picture(const std::filesystem::path& file, SceneRenderer& renderer, ViewerState& state,
                   const Palette& palette, const Eigen::Vector2i& size, const PictureOptions& options);

/// Turns the camera about its target and its up axis by this part of a whole turn.
CameraPose turned(const Camera& camera, const CameraPose& pose, double part);

}  // namespace elastolab
