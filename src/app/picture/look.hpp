#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "app/picture/drawing_detail.hpp"
#include "app/picture/palette.hpp"
#include "app/viewer_state.hpp"

namespace elastolab {

/// All that the picture of a viewport depends on: the same look, the same picture.
struct Look {
    std::vector<MethodKind> kinds;
    std::vector<std::uint64_t> body_revisions;
    Eigen::Vector3d camera_target, camera_up, camera_scene;
    Eigen::Vector4d camera_turn;
    double camera_distance = 0.0, pixel_ratio = 0.0, width = 0.0, height = 0.0, covered = 0.0;
    Projection projection = Projection::perspective;
    DisplaySettings display;
    std::pair<double, double> range;
    Hover hover;
    int selected_handle = -1, selected_fixed = -1;
    std::optional<int> selected_load = {};
    bool pulling = false;
    std::uint64_t scene_number = 0, scene_revision = 0;
    const Palette* palette = nullptr;
    DrawingDetail detail;
    bool operator==(const Look&) const = default;
};

/// With all detail; `pixel_ratio` framebuffer pixels make one logical pixel.
Look look_of(const ViewerState& state, const SceneViewport& viewport, const Palette& palette, double pixel_ratio);

}  // namespace elastolab
