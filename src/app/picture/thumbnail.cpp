#include "app/picture/thumbnail.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "render/gl/image.hpp"

namespace elastolab {

namespace {

constexpr int kSamples = 3;  ///< along an edge of a pixel
constexpr double kMargin = 0.04;

/// Where the picture is seen from: x to the right, y up, z towards the eye.
Eigen::Matrix3d view_axes() {
    constexpr double kAzimuth = -1.0, kHeight = 0.45;
    const Eigen::Vector3d back(std::cos(kHeight) * std::cos(kAzimuth), std::cos(kHeight) * std::sin(kAzimuth),
                               std::sin(kHeight));
    const Eigen::Vector3d right = Eigen::Vector3d::UnitZ().cross(back).normalized();
    Eigen::Matrix3d axes;
    axes << right.transpose(), back.cross(right).transpose(), back.transpose();
    return axes;
}

/// Vertices in samples of the picture: x to the right, y down, z towards the eye.
Positions on_screen(const Positions& vertices, int n_samples) {
    Positions x = view_axes() * vertices;
    x.row(1) *= -1.0;
    const Eigen::Vector3d low = x.rowwise().minCoeff(), high = x.rowwise().maxCoeff();
    const double extent = std::max(high.x() - low.x(), high.y() - low.y());
    const double scale = extent > 0.0 ? (1.0 - 2.0 * kMargin) * n_samples / extent : 1.0;
    x.colwise() -= 0.5 * (low + high);
    x *= scale;
    x.topRows<2>().array() += 0.5 * n_samples;
    return x;
}

/// The nearest surface at each sample: its shade, or nothing.
class Raster {
public:
    explicit Raster(int n)
        : n_(n),
          depth_(static_cast<std::size_t>(n) * static_cast<std::size_t>(n), -std::numeric_limits<float>::max()),
          shade_(depth_.size(), 0.0F) {}

    void draw(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
        const Eigen::Vector3d normal = (b - a).cross(c - a);
        const double area = normal.z(), length = normal.norm();
        if (area == 0.0 || !std::isfinite(length)) return;
        const auto shade = static_cast<float>(0.4 + 0.6 * std::abs(normal.dot(kLight)) / length);
        const auto [x0, x1] = std::minmax({a.x(), b.x(), c.x()});
        const auto [y0, y1] = std::minmax({a.y(), b.y(), c.y()});
        for (int j = first(y0); j <= last(y1); ++j)
            for (int i = first(x0); i <= last(x1); ++i) {
                const Eigen::Vector3d p(i + 0.5, j + 0.5, 0.0);
                const double u = (c - b).cross(p - b).z() / area, v = (a - c).cross(p - c).z() / area, w = 1.0 - u - v;
                if (u < 0.0 || v < 0.0 || w < 0.0) continue;
                put(i, j, static_cast<float>(u * a.z() + v * b.z() + w * c.z()), shade);
            }
    }

    /// The mean of the samples of each pixel: red, green, blue, opacity.
    std::vector<std::uint8_t> pixels() const {
        const int size = n_ / kSamples;
        std::vector<std::uint8_t> result;
        result.reserve(4 * static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
        for (int j = 0; j < size; ++j)
            for (int i = 0; i < size; ++i) add_pixel(i, j, result);
        return result;
    }

private:
    static inline const Eigen::Vector3d kLight = Eigen::Vector3d(0.35, -0.55, 0.75).normalized();

    int first(double x) const { return std::max(0, static_cast<int>(std::floor(x - 0.5))); }
    int last(double x) const { return std::min(n_ - 1, static_cast<int>(std::ceil(x - 0.5))); }
    std::size_t at(int i, int j) const {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(n_) + static_cast<std::size_t>(i);
    }
    void put(int i, int j, float depth, float shade) {
        if (depth <= depth_[at(i, j)]) return;
        depth_[at(i, j)] = depth;
        shade_[at(i, j)] = shade;
    }
    void add_pixel(int i, int j, std::vector<std::uint8_t>& pixels) const {
        constexpr float kColour[3] = {150.0F, 178.0F, 214.0F};
        float sum = 0.0F;
        int n_covered = 0;
        for (int y = 0; y < kSamples; ++y)
            for (int x = 0; x < kSamples; ++x) {
                const float shade = shade_[at(kSamples * i + x, kSamples * j + y)];
                sum += shade;
                n_covered += shade > 0.0F ? 1 : 0;
            }
        const float mean = n_covered > 0 ? sum / static_cast<float>(n_covered) : 0.0F;
        for (const float c : kColour) pixels.push_back(static_cast<std::uint8_t>(std::lround(mean * c)));
        pixels.push_back(static_cast<std::uint8_t>(255 * n_covered / (kSamples * kSamples)));
    }

    int n_;
    std::vector<float> depth_, shade_;
};

}  // namespace

void write_thumbnail(const std::filesystem::path& file, const SurfaceMesh& surface, int size) {
    Raster raster(kSamples * size);
    if (surface.n_triangles() > 0) {
        const Positions x = on_screen(surface.vertices, kSamples * size);
        for (const auto& t : surface.triangles.colwise()) raster.draw(x.col(t[0]), x.col(t[1]), x.col(t[2]));
    }
    write_png_channels(file, size, size, 4, raster.pixels().data());
}

}  // namespace elastolab
