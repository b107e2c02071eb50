#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

namespace elastolab::test {

/// The colours of a PNG file.
class Pixels {
public:
    explicit Pixels(const std::filesystem::path& file);
    /// 0 to 255; black outside, and everywhere when the file cannot be read.
    Eigen::Vector3i at(const Eigen::Vector2d& pixel) const;

private:
    int width_ = 0, height_ = 0;
    std::vector<unsigned char> colours_;
};

}  // namespace elastolab::test
