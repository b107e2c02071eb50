#pragma once

#include <Eigen/Core>

#include "render/gl/gl_object.hpp"
#include "render/gl/image.hpp"

namespace elastolab {

/// A picture that is drawn off the screen: multisampled colour and depth, resolved to a texture.
class Framebuffer {
public:
    /// Sizes in framebuffer pixels, >= 1. Fewer samples when the driver has no more; 1 for none. Throws Error when the
    /// driver refuses.
    Framebuffer(int width, int height, int samples = 4);

    int width() const { return width_; }
    int height() const { return height_; }
    /// New storage when the size differs; the picture is then undefined.
    void resize(int width, int height);

    /// This is a tile of a larger picture of that size; its bottom left corner is at (x, y) there.
    void be_tile_of(int width, int height, int x, int y) { whole_ = {x, y, width, height}; }
    bool is_tile() const { return whole_.width > 0; }
    /// Draws go here from now on; the viewport is all of it, or the whole picture that it is a tile of.
    void bind() const;
    /// Resolves what was drawn to texture().
    void resolve() const;
    /// Colours after resolve(), the bottom row first (v upward).
    unsigned texture() const { return texture_.id(); }
    /// Resolves the depths of what was drawn, one sample a pixel, to depth_texture(). Draws go here again afterwards.
    void resolve_depth() const;
    unsigned depth_texture() const { return depth_texture_.id(); }
    /// Its bottom left corner in the picture that it is a tile of; (0, 0) when it is none.
    Eigen::Vector2i place() const { return {whole_.x, whole_.y}; }
    /// resolve(), then a copy. Waits for the graphics card.
    Image read() const;
    /// After resolve(): to the window at (x, y) from its bottom left corner, as so many of its pixels: one by one where
    /// that is this picture's size, else smoothed.
    void copy_to_window(int x, int y, int width, int height) const;

private:
    friend class DepthBuffer;
    void allocate();

    struct Whole {
        int x = 0, y = 0, width = 0, height = 0;
    };
    int width_, height_, samples_;
    Whole whole_;
    GlTexture texture_, depth_texture_;
    GlRenderbuffer colour_, depth_;
    GlFramebuffer drawn_, resolved_;
};

/// The depths of a whole picture, gathered from its tiles.
class DepthBuffer {
public:
    /// Throws Error when the driver refuses the size.
    DepthBuffer(int width, int height);
    int width() const { return width_; }
    int height() const { return height_; }
    /// Takes the depths of this tile. Draws go to it again afterwards.
    void take(const Framebuffer& tile);
    unsigned texture() const { return texture_.id(); }

private:
    int width_, height_;
    GlTexture texture_;
    GlFramebuffer gathered_;
};

/// A picture of one number a pixel, 0 to 1, drawn on the way to another.
class MaskBuffer {
public:
    enum class Depth { none, tested };
    explicit MaskBuffer(Depth depth);
    /// Draws go here from now on, to all of it, which holds `value`. Sizes in pixels, >= 1.
    void bind(int width, int height, float value);
    unsigned texture() const { return texture_.id(); }

private:
    int width_ = 0, height_ = 0;
    GlTexture texture_;
    GlRenderbuffer depth_;
    GlFramebuffer drawn_;
};

/// Draws go to the window from now on; its size in framebuffer pixels.
void bind_window(int width, int height);

}  // namespace elastolab
