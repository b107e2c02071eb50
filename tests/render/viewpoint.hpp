#pragma once

#include "render/camera.hpp"

namespace elastolab::test {

/// A camera that looks at a ball of this size, somewhat from the side.
inline Camera camera_at(const SceneFrame& ball, const Viewport& viewport) {
    Camera camera;
    camera.set_scene(ball);
    camera.set_view(ViewDirection::isometric);
    camera.frame(ball, viewport.aspect());
    return camera;
}

}  // namespace elastolab::test
