#include "app/pixels.hpp"

#include <stb_image.h>

#include <memory>

namespace elastolab::test {

Pixels::Pixels(const std::filesystem::path& file) {
    const std::unique_ptr<stbi_uc, void (*)(void*)> read(stbi_load(file.c_str(), &width_, &height_, nullptr, 3),
                                                         stbi_image_free);
    if (read) colours_.assign(read.get(), read.get() + 3 * std::ptrdiff_t{width_} * height_);
}

Eigen::Vector3i Pixels::at(const Eigen::Vector2d& pixel) const {
    const auto x = static_cast<int>(pixel.x()), y = static_cast<int>(pixel.y());
    if (colours_.empty() || x < 0 || y < 0 || x >= width_ || y >= height_) return Eigen::Vector3i::Zero();
    const unsigned char* place = colours_.data() + 3 * (std::ptrdiff_t{y} * width_ + x);
    return {place[0], place[1], place[2]};
}

}  // namespace elastolab::test
