#include "render/gl/image.hpp"

#include <stb_image_write.h>

#include "base/atomic_file.hpp"
#include "base/error.hpp"

namespace elastolab {

void write_png(const std::filesystem::path& path, const Image& image) {
    write_png_channels(path, image.width, image.height, 3, image.pixels.data());
}

void write_png_channels(const std::filesystem::path& path, int width, int height, int channels,
                        const std::uint8_t* pixels) {
    AtomicFile file(path);
    const auto append = [](void* stream, void* data, int size) {
        static_cast<std::ostream*>(stream)->write(static_cast<const char*>(data), size);
    };
    const int ok = stbi_write_png_to_func(append, static_cast<std::ostream*>(&file.stream()), width, height, channels,
                                          pixels, channels * width);
    if (ok == 0) throw Error(path.string() + ": the picture is too large for memory. Choose a smaller size.");
    file.commit();
}

}  // namespace elastolab
