#include "render/gl/image.hpp"

#include <stb_image_write.h>

#include <limits>
#include <string>

#include "base/atomic_file.hpp"
#include "base/error.hpp"

namespace elastolab {

void write_png(const std::filesystem::path& path, const Image& image) {
    write_png_channels(path, image.width, image.height, 3, image.pixels.data());
}

void write_png_channels(const std::filesystem::path& path, int width, int height, int channels,
                        const std::uint8_t* pixels) {
    const std::string too_large = path.string() + ": the picture is too large for memory. Choose a smaller size.";
    // stb counts the bytes of all rows, each with its filter, in an int.
    if ((1 + std::int64_t{channels} * width) * height > std::numeric_limits<int>::max()) throw Error(too_large);
    AtomicFile file(path);
    const auto append = [](void* stream, void* data, int size) {
        static_cast<std::ostream*>(stream)->write(static_cast<const char*>(data), size);
    };
    const int ok = stbi_write_png_to_func(append, static_cast<std::ostream*>(&file.stream()), width, height, channels,
                                          pixels, channels * width);
    if (ok == 0) throw Error(too_large);
    file.commit();
}

}  // namespace elastolab
