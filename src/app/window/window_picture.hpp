#pragma once

#include <Eigen/Core>

#include "render/gl/image.hpp"

namespace elastolab {

/// What was just drawn into the window of this size [framebuffer pixels], before the buffers are swapped.
Image window_picture(const Eigen::Vector2i& size);

}  // namespace elastolab
