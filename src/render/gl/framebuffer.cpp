#include "render/gl/framebuffer.hpp"

#include <epoxy/gl.h>

#include <algorithm>

#include "base/error.hpp"

namespace elastolab {

namespace {

void require_complete() {
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw Error("picture: the graphics driver has no room for it. Choose a smaller size.");
}

struct TexelFormat {
    GLint stored;
    GLenum components, type;
    GLint filter;
};
constexpr TexelFormat kColour{GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, GL_LINEAR};
constexpr TexelFormat kDepth{GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, GL_NEAREST};
constexpr TexelFormat kMask{GL_R8, GL_RED, GL_UNSIGNED_BYTE, GL_LINEAR};

void allocate_texture(const GlTexture& texture, const TexelFormat& format, int width, int height) {
    glBindTexture(GL_TEXTURE_2D, texture.id());
    glTexImage2D(GL_TEXTURE_2D, 0, format.stored, width, height, 0, format.components, format.type, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, format.filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, format.filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void allocate_renderbuffer(const GlRenderbuffer& buffer, int samples, GLenum format, int width, int height) {
    glBindRenderbuffer(GL_RENDERBUFFER, buffer.id());
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples > 1 ? samples : 0, format, width, height);
}

}  // namespace

Framebuffer::Framebuffer(int width, int height, int samples)
    : width_(width),
      height_(height),
      samples_(samples),
      texture_(make_gl_texture()),
      depth_texture_(make_gl_texture()),
      colour_(make_gl_renderbuffer()),
      depth_(make_gl_renderbuffer()),
      drawn_(make_gl_framebuffer()),
      resolved_(make_gl_framebuffer()) {
    GLint most = 1;
    glGetIntegerv(GL_MAX_SAMPLES, &most);
    samples_ = std::min(samples, static_cast<int>(most));
    allocate();
}

void Framebuffer::allocate() {
    allocate_texture(texture_, kColour, width_, height_);
    allocate_texture(depth_texture_, kDepth, width_, height_);
    allocate_renderbuffer(colour_, samples_, GL_RGBA8, width_, height_);
    allocate_renderbuffer(depth_, samples_, GL_DEPTH_COMPONENT24, width_, height_);
    glBindFramebuffer(GL_FRAMEBUFFER, drawn_.id());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_.id());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
    require_complete();
    glBindFramebuffer(GL_FRAMEBUFFER, resolved_.id());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.id(), 0);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_texture_.id(), 0);
    require_complete();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void Framebuffer::resize(int width, int height) {
    if (width == width_ && height == height_) return;
    width_ = width;
    height_ = height;
    allocate();
}

void Framebuffer::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, drawn_.id());
    if (is_tile())
        glViewport(-whole_.x, -whole_.y, whole_.width, whole_.height);
    else
        glViewport(0, 0, width_, height_);
}

void Framebuffer::resolve() const {
    glDisable(GL_SCISSOR_TEST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn_.id());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.id());
    glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, drawn_.id());
}

void Framebuffer::resolve_depth() const {
    glDisable(GL_SCISSOR_TEST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn_.id());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.id());
    glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
    bind();
}

Image Framebuffer::read() const {
    resolve();
    const std::size_t row = 3 * static_cast<std::size_t>(width_), rows = static_cast<std::size_t>(height_);
    Image image{width_, height_, std::vector<std::uint8_t>(row * rows)};
    glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.id());
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width_, height_, GL_RGB, GL_UNSIGNED_BYTE, image.pixels.data());
    glBindFramebuffer(GL_FRAMEBUFFER, drawn_.id());
    const auto row_at = [&](std::size_t y) { return image.pixels.begin() + static_cast<std::ptrdiff_t>(y * row); };
    for (std::size_t y = 0; y < rows / 2; ++y) std::swap_ranges(row_at(y), row_at(y + 1), row_at(rows - 1 - y));
    return image;
}

void Framebuffer::copy_to_window(int x, int y, int width, int height) const {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.id());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    const bool same = width == width_ && height == height_;
    glBlitFramebuffer(0, 0, width_, height_, x, y, x + width, y + height, GL_COLOR_BUFFER_BIT,
                      same ? GL_NEAREST : GL_LINEAR);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

DepthBuffer::DepthBuffer(int width, int height)
    : width_(width), height_(height), texture_(make_gl_texture()), gathered_(make_gl_framebuffer()) {
    allocate_texture(texture_, kDepth, width, height);
    glBindFramebuffer(GL_FRAMEBUFFER, gathered_.id());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture_.id(), 0);
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
    require_complete();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void DepthBuffer::take(const Framebuffer& tile) {
    tile.resolve_depth();
    const Eigen::Vector2i low = tile.place(), high = low + Eigen::Vector2i(tile.width(), tile.height());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, tile.resolved_.id());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, gathered_.id());
    glBlitFramebuffer(0, 0, tile.width(), tile.height(), low.x(), low.y(), high.x(), high.y(), GL_DEPTH_BUFFER_BIT,
                      GL_NEAREST);
    tile.bind();
}

MaskBuffer::MaskBuffer(Depth depth) : texture_(make_gl_texture()), drawn_(make_gl_framebuffer()) {
    if (depth == Depth::tested) depth_ = make_gl_renderbuffer();
}

void MaskBuffer::bind(int width, int height, float value) {
    const bool is_new = width != width_ || height != height_;
    width_ = width;
    height_ = height;
    if (is_new) allocate_texture(texture_, kMask, width, height);
    glBindFramebuffer(GL_FRAMEBUFFER, drawn_.id());
    if (is_new) {
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.id(), 0);
        if (depth_) {
            allocate_renderbuffer(depth_, 1, GL_DEPTH_COMPONENT24, width, height);
            glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
        }
        require_complete();
    }
    glViewport(0, 0, width, height);
    apply({});
    glClearColor(value, value, value, value);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void bind_window(int width, int height) {
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, width, height);
}

}  // namespace elastolab
