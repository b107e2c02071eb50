#include "app/window/window_picture.hpp"

#include <epoxy/gl.h>

#include <algorithm>

namespace elastolab {

Image window_picture(const Eigen::Vector2i& size) {
    Image image{.width = size.x(), .height = size.y(), .pixels = {}};
    const std::size_t row = 3 * static_cast<std::size_t>(size.x()), n_rows = static_cast<std::size_t>(size.y());
    image.pixels.resize(row * n_rows);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    glReadBuffer(GL_BACK);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, size.x(), size.y(), GL_RGB, GL_UNSIGNED_BYTE, image.pixels.data());
    const auto begin = image.pixels.begin();
    for (std::size_t y = 0; y < n_rows / 2; ++y)  // OpenGL's rows begin at the bottom
        std::swap_ranges(begin + static_cast<std::ptrdiff_t>(y * row),
                         begin + static_cast<std::ptrdiff_t>((y + 1) * row),
                         begin + static_cast<std::ptrdiff_t>((n_rows - 1 - y) * row));
    return image;
}

}  // namespace elastolab
