#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "render/gl/image.hpp"

namespace elastolab {

/// An RGBA picture, 8 bits a channel, rows from the top; colours are not multiplied by their opacity (as in PNG).
struct TransparentImage {
    int width = 0, height = 0;
    std::vector<std::uint8_t> pixels;  ///< 4 x width x height
};

/// The picture that looks like these two over black and over white: its opacity is 1 minus their difference, whatever
/// was drawn and blended in between. Both have the same size.
TransparentImage matte(const Image& on_black, const Image& on_white);

/// Throws Error when the file cannot be written; then what was there before is left alone.
void write_png(const std::filesystem::path& path, const TransparentImage& image);

}  // namespace elastolab
