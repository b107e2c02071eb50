#pragma once

#include <Eigen/Core>

#include "render/gl/arrays.hpp"

namespace elastolab {

/// A ball around what is drawn. Drawings keep their vertices as (position - center) / radius, in single precision, so
/// that a scene of any size and place is drawn alike.
struct SceneFrame {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    double radius = 1.0;  ///< [L], positive

    Eigen::Vector3f local(const Eigen::Vector3d& position) const {
        return ((position - center) / radius).cast<float>();
    }
};

/// The ball around the bounding box of these positions; a radius of 1 when they have no extent.
SceneFrame frame_of(const PositionsView& positions);

}  // namespace elastolab
