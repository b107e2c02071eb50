#pragma once

#include <filesystem>

#include "render/gl/gl_object.hpp"

namespace elastolab {

/// A picture of our own from a PNG file, on the graphics card.
class PictureTexture {
public:
    /// Throws Error when the file cannot be read.
    explicit PictureTexture(const std::filesystem::path& file);

    unsigned id() const { return texture_.id(); }
    int width() const { return width_; }
    int height() const { return height_; }

private:
    int width_ = 0, height_ = 0;
    GlTexture texture_;
};

}  // namespace elastolab
