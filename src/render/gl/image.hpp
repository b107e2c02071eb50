#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace elastolab {

/// An RGB picture, 8 bits a channel, rows from the top.
struct Image {
    int width = 0, height = 0;
    std::vector<std::uint8_t> pixels;  ///< 3 x width x height

    std::array<int, 3> at(int x, int y) const {
        const std::size_t i =
            3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
        return {pixels[i], pixels[i + 1], pixels[i + 2]};
    }
};

/// Throws Error when the file cannot be written; then what was there before is left alone.
void write_png(const std::filesystem::path& path, const Image& image);
/// Writes width x height pixels of `channels` bytes each, 3 or 4. Throws as write_png, and where they are more than 2
/// GB.
void write_png_channels(const std::filesystem::path& path, int width, int height, int channels,
                        const std::uint8_t* pixels);

}  // namespace elastolab
