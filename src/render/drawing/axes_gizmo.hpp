#pragma once

#include <array>
#include <Eigen/Core>
#include <optional>

#include "render/camera.hpp"
#include "render/colour.hpp"
#include "render/drawing/arrows_drawing.hpp"

namespace elastolab {

/// The three world axes in a corner of the picture, as the camera sees them.
class AxesGizmo {
public:
    /// Where its letters belong [logical pixels].
    struct Labels {
        std::array<Eigen::Vector2d, 3> pixel;
        std::array<double, 3> depth;  ///< larger is farther: write the far ones first
    };

    /// Where it is drawn in a viewport: its lower left corner [logical pixels].
    static Viewport place_in(const Viewport& viewport);
    /// The axis whose letter is under the cursor.
    static std::optional<int> axis_at(const Camera& camera, const Viewport& place, const Eigen::Vector2d& cursor);

    explicit AxesGizmo(const std::array<Colour, 3>& colours);
    /// Draws into the square `place` of the picture that `viewport` shows, over what is there. Last in a frame.
    void draw(const Camera& camera, const Viewport& viewport, const Viewport& place, double pixel_ratio);
    static Labels labels(const Camera& camera, const Viewport& place);

private:
    ArrowsDrawing arrows_;
};

}  // namespace elastolab
