#include "render/gl/picture_texture.hpp"

#include <epoxy/gl.h>
#include <stb_image.h>

#include <memory>

#include "base/error.hpp"

namespace elastolab {

PictureTexture::PictureTexture(const std::filesystem::path& file) : texture_(make_gl_texture()) {
    constexpr int kChannels = 4;
    int channels_in_file = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load(file.c_str(), &width_, &height_, &channels_in_file, kChannels), stbi_image_free);
    if (!pixels) throw Error(file.string() + ": cannot be read (" + stbi_failure_reason() + "). Install it again.");
    glBindTexture(GL_TEXTURE_2D, texture_.id());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width_, height_, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels.get());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

}  // namespace elastolab
