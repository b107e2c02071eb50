#include "render/pixels/canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace elastolab {

void Canvas::blend(int x, int y, const Colour& colour, float cover) {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
    const auto place = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    std::uint8_t* const pixel = pixels_ + static_cast<std::size_t>(channels_) * place;
    const float over = std::clamp(cover * colour.a, 0.0f, 1.0f);
    const float under = (channels_ == 4 ? static_cast<float>(pixel[3]) / 255.0f : 1.0f) * (1.0f - over);
    const float sum = over + under;
    if (sum <= 0.0f) return;
    const std::array<float, 3> own = {colour.r, colour.g, colour.b};
    for (std::size_t i = 0; i < 3; ++i) {
        const float mixed = (255.0f * own[i] * over + static_cast<float>(pixel[i]) * under) / sum;
        pixel[i] = static_cast<std::uint8_t>(std::lround(std::clamp(mixed, 0.0f, 255.0f)));
    }
    if (channels_ == 4) pixel[3] = static_cast<std::uint8_t>(std::lround(255.0f * sum));
}

void Canvas::fill_rectangle(double left, double top, double right, double bottom, const Colour& colour,
                            double corner_radius) {
    const double radius = std::min({corner_radius, 0.5 * (right - left), 0.5 * (bottom - top)});
    const double half_width = 0.5 * (right - left) - radius, half_height = 0.5 * (bottom - top) - radius;
    const auto last_x = static_cast<int>(std::ceil(right)), last_y = static_cast<int>(std::ceil(bottom));
    for (int y = static_cast<int>(std::floor(top)); y < last_y; ++y)
        for (int x = static_cast<int>(std::floor(left)); x < last_x; ++x) {
            // Distance of the middle of the pixel from the rounded outline, positive outside.
            const double dx = std::abs(x + 0.5 - 0.5 * (left + right)) - half_width;
            const double dy = std::abs(y + 0.5 - 0.5 * (top + bottom)) - half_height;
            const double outside = std::hypot(std::max(dx, 0.0), std::max(dy, 0.0)) + std::min(std::max(dx, dy), 0.0);
            blend(x, y, colour, static_cast<float>(std::clamp(0.5 - (outside - radius), 0.0, 1.0)));
        }
}

}  // namespace elastolab
