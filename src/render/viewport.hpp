#pragma once

#include <Eigen/Core>

namespace elastolab {

/// The part of the window that shows the scene, in logical pixels from the top left corner of the window. Cursor
/// positions are in the same coordinates.
struct Viewport {
    double x = 0.0, y = 0.0, width = 1.0, height = 1.0;
    double covered = 0.0;  ///< of the width, at its right, by what stands over it: the view is centred in the rest

    double aspect() const { return width / height; }
    double free_aspect() const { return (width - covered) / height; }
    /// Of what is not covered.
    Eigen::Vector2d center() const { return {x + 0.5 * (width - covered), y + 0.5 * height}; }
    bool contains(const Eigen::Vector2d& pixel) const {
        return pixel.x() >= x && pixel.x() < x + width && pixel.y() >= y && pixel.y() < y + height;
    }
};

}  // namespace elastolab
