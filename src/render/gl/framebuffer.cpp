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

void allocate_texture(const GlTexture& texture, int width, int height) {
    glBindTexture(GL_TEXTURE_2D, texture.id());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
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
    allocate_texture(texture_, width_, height_);
    allocate_renderbuffer(colour_, samples_, GL_RGBA8, width_, height_);
    allocate_renderbuffer(depth_, samples_, GL_DEPTH_COMPONENT24, width_, height_);
    glBindFramebuffer(GL_FRAMEBUFFER, drawn_.id());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_.id());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
    require_complete();
    glBindFramebuffer(GL_FRAMEBUFFER, resolved_.id());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.id(), 0);
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
    glViewport(0, 0, width_, height_);
}

void Framebuffer::resolve() const {
    glDisable(GL_SCISSOR_TEST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn_.id());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.id());
    glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, drawn_.id());
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

void Framebuffer::copy_to_window(int x, int y) const {
    resolve();
    glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.id());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glBlitFramebuffer(0, 0, width_, height_, x, y, x + width_, y + height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void bind_window(int width, int height) {
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, width, height);
}

}  // namespace elastolab
