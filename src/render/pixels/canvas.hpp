#pragma once

#include <cstdint>

#include "render/colour.hpp"
#include "render/gl/image.hpp"
#include "render/gl/matte.hpp"

namespace elastolab {

/// A picture in memory to draw on. Places are in its pixels from the top left; what lies outside is left out. Over a
/// transparent picture what is drawn adds its opacity.
class Canvas {
public:
    explicit Canvas(Image& image) : Canvas(image.pixels.data(), image.width, image.height, 3) {}
    explicit Canvas(TransparentImage& image) : Canvas(image.pixels.data(), image.width, image.height, 4) {}

    int width() const { return width_; }
    int height() const { return height_; }

    /// Draws on one pixel, of which the part `cover` in [0, 1] is covered; the colour's opacity counts too.
    void blend(int x, int y, const Colour& colour, float cover);
    /// Edges and round corners are smoothed.
    void fill_rectangle(double left, double top, double right, double bottom, const Colour& colour,
                        double corner_radius = 0.0);

private:
    Canvas(std::uint8_t* pixels, int width, int height, int channels)
        : pixels_(pixels), width_(width), height_(height), channels_(channels) {}

    std::uint8_t* pixels_;
    int width_, height_, channels_;
};

}  // namespace elastolab
