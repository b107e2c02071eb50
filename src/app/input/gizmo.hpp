#pragma once

#include <Eigen/Core>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "app/settings.hpp"
#include "render/camera.hpp"
#include "scene/live/live_scene.hpp"

namespace elastolab {

/// What can be taken hold of at a gizmo: an arrow moves along an axis, a ring turns about it.
struct GizmoPart {
    enum class Kind { arrow, ring };
    Kind kind = Kind::arrow;
    int axis = 0;
    bool operator==(const GizmoPart&) const = default;
};

/// Arrows and rings of one size on the screen around a point: to move and turn a handle, or the plane of the cut.
struct Gizmo {
    static constexpr int kPlane = -1;    ///< instead of a handle: the plane that cuts the body open
    static constexpr int kGravity = -2;  ///< likewise: the direction of gravity

    int handle = kPlane;
    Eigen::Vector3d center = Eigen::Vector3d::Zero();    ///< as shown [L]
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns of unit length
    std::vector<GizmoPart> parts = {};                   ///< that it has
    double pixels = 90.0;                                ///< length of the arrows on the screen
};

/// At a handle as it is shown: `positions` are those of all vertices.
Gizmo handle_gizmo(const LiveScene& scene, int handle, const Positions& positions, GizmoAxes axes);
/// Around the middle of the body as it is shown: rings that turn gravity.
Gizmo gravity_gizmo(const Positions& positions);
/// At the plane of the cut, through the middle of the body at rest: an arrow normal to it and rings for turn and tilt.
Gizmo plane_gizmo(const Positions& rest, const DisplaySettings& display);

/// A part as it is seen, a line of points [logical pixels]; of a ring the half towards the eye. Empty where it is
/// behind the eye, and for an arrow that points at the eye.
std::vector<Eigen::Vector2d> outline(const Gizmo& gizmo, const GizmoPart& part, const Camera& camera,
                                     const Viewport& viewport);
/// What the cursor can take hold of; the middle is left to what lies under it.
std::optional<GizmoPart> part_at(const Gizmo& gizmo, const Camera& camera, const Viewport& viewport,
                                 const Eigen::Vector2d& cursor);
/// How far a part has been dragged between two places of the cursor: along its axis [L], or about it [radians].
double dragged(const Gizmo& gizmo, const GizmoPart& part, const Camera& camera, const Viewport& viewport,
               const Eigen::Vector2d& from, const Eigen::Vector2d& to);

/// How far the cursor, moved from one place to the other, drags a point along this direction (of unit length) [L]; 0
/// where the direction points at the eye.
double dragged_along(const Camera& camera, const Viewport& viewport, const Eigen::Vector3d& point,
                     const Eigen::Vector3d& direction, const Eigen::Vector2d& from, const Eigen::Vector2d& to);

/// Steps of snapping: a round length near a hundredth of the body's diagonal [L], and an angle [radians].
double snap_length(const LiveScene& scene);
constexpr double kSnapAngle = std::numbers::pi / 12.0;
double snapped(double value, double step);

}  // namespace elastolab
