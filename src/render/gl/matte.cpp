#include "render/gl/matte.hpp"

#include <algorithm>
#include <cassert>

namespace elastolab {

TransparentImage matte(const Image& on_black, const Image& on_white) {
    assert(on_black.pixels.size() == on_white.pixels.size());
    TransparentImage image{on_black.width, on_black.height, {}};
    image.pixels.reserve(on_black.pixels.size() / 3 * 4);
    for (std::size_t i = 0; i + 2 < on_black.pixels.size(); i += 3) {
        int seen_through = 255;  // by the most opaque channel; light that is added hides nothing
        for (std::size_t c = 0; c < 3; ++c)
            seen_through = std::min(seen_through, on_white.pixels[i + c] - on_black.pixels[i + c]);
        const int opacity = 255 - std::clamp(seen_through, 0, 255);
        for (std::size_t c = 0; c < 3; ++c) {
            const int colour = opacity > 0 ? (255 * on_black.pixels[i + c] + opacity / 2) / opacity : 0;
            image.pixels.push_back(static_cast<std::uint8_t>(std::min(colour, 255)));
        }
        image.pixels.push_back(static_cast<std::uint8_t>(opacity));
    }
    return image;
}

void write_png(const std::filesystem::path& path, const TransparentImage& image) {
    write_png_channels(path, image.width, image.height, 4, image.pixels.data());
}

}  // namespace elastolab
