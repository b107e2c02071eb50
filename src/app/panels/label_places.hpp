#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "render/viewport.hpp"

namespace elastolab {

/// Where words beside points of a viewport stand, so that all of them can be read.
class LabelPlaces {
public:
    using Box = Eigen::AlignedBox2d;  ///< [logical pixels]

    /// Words keep inside the part of the viewport that nothing covers, less a margin.
    LabelPlaces(const Viewport& viewport, double margin);

    /// Width above which words do not fit and are to be broken.
    double width() const { return room_.sizes().x(); }
    /// What no words are to cover.
    void cover(const Box& box) { taken_.push_back(box); }
    /// Takes the place of words of this size beside a point: to its right where that is free, else to its left, above,
    /// below, or higher and lower at either side. Where nothing is free they cover the least.
    Box take(const Eigen::Vector2d& point, const Eigen::Vector2d& size, double gap);

private:
    /// Moved into the room, as far as it fits.
    Box inside(Box box) const;
    double covered_area(const Box& box) const;

    Box room_;
    std::vector<Box> taken_;
};

}  // namespace elastolab
