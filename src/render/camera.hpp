#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "render/gl/arrays.hpp"
#include "render/scene_frame.hpp"
#include "render/viewport.hpp"

namespace elastolab {

struct Ray {
    Eigen::Vector3d origin, direction;  ///< direction of unit length
};

/// Where a point appears, and how far it is from the eye along the viewing direction [L]; behind the eye if not > 0.
struct ProjectedPoint {
    Eigen::Vector2d pixel;
    double depth = 0.0;
};

/// Directions to look from. World axes: the camera's up axis is up, `front` looks along +Y (or along -Z when Y is up).
enum class ViewDirection { front, back, left, right, top, bottom, isometric };

/// Where the camera is: enough to come back to a view.
struct CameraPose {
    Eigen::Vector3d target = Eigen::Vector3d::Zero();                 ///< the point it turns about
    Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< camera axes (right, up, backward) to world
    double distance = 4.0;  ///< from the eye to the target, seen in perspective [L]
};

/// What the picture is like: as an eye sees it, or with parallel lines of sight, so that lengths can be compared.
enum class Projection { perspective, orthographic };

/// A camera. Orthographic pictures are those of an eye that is so far away, with so long a lens, that depth changes
/// lengths by less than a thousandth; everything else then holds for both. Pixels are logical, with the origin at the
/// top left of the window and y downward. Everything is relative to the size of the scene, which may be anything
/// between 1e-9 and 1e9 and far from the origin.
class Camera {
public:
    /// Changes what is seen in the plane of the target by nothing.
    void set_projection_kind(Projection kind) { kind_ = kind; }
    Projection projection_kind() const { return kind_; }
    /// How much farther away the eye is than in perspective: 1 there.
    double remoteness() const;

    /// What must be in sight: sets the near and far planes and the range of zoom, not the view.
    void set_scene(const SceneFrame& scene) { scene_ = scene; }
    const SceneFrame& scene() const { return scene_; }
    /// The axis that orbit() turns about and that the views have on top: +Z unless set. Of unit length.
    void set_up_axis(const Eigen::Vector3d& axis) { up_axis_ = axis; }
    const Eigen::Vector3d& up_axis() const { return up_axis_; }

    const CameraPose& pose() const { return pose_; }
    void set_pose(const CameraPose& pose) { pose_ = pose; }
    Eigen::Vector3d eye() const { return pose_.target + eye_distance() * backward(); }
    Eigen::Vector3d right() const { return pose_.orientation * Eigen::Vector3d::UnitX(); }
    Eigen::Vector3d up() const { return pose_.orientation * Eigen::Vector3d::UnitY(); }
    Eigen::Vector3d backward() const { return pose_.orientation * Eigen::Vector3d::UnitZ(); }

    /// World to eye coordinates (x right, y up, z backward) [L].
    Eigen::Matrix4d view() const;
    /// Eye to clip coordinates, for eye coordinates in units of `unit` [L]. The depth range holds a few scene radii
    /// around the scene, and stays clear of the eye.
    Eigen::Matrix4d projection(const Viewport& viewport, double unit = 1.0) const;

    /// A drag of the cursor by (dx, dy) pixels turns the view about the target: sideways about the up axis, up and
    /// down until it looks along that axis. The height of the viewport is half a turn.
    void orbit(double dx, double dy, const Viewport& viewport);
    /// Moves the view so that what is seen at `from` in the plane of the target is then seen at `to`.
    void pan(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Viewport& viewport);
    /// Comes closer by `factor` > 1, or goes back by factor < 1. The point under the cursor in the plane through
    /// `anchor` parallel to the screen stays there. The distance stays within 1e-4 to 1e3 scene radii.
    void zoom_to(const Eigen::Vector2d& cursor, double factor, const Eigen::Vector3d& anchor, const Viewport& viewport);
    /// Puts this ball in the middle, as large as fits into a free part of a viewport of this aspect. Keeps the
    /// orientation.
    void frame(const SceneFrame& ball, double aspect);
    /// Moves and comes as near as these points (one column each) allow there, with a margin. Keeps the orientation.
    void fit(const PositionsView& points, double aspect);
    /// Turns about the target to look from there.
    void set_view(ViewDirection from);
    /// Turns about the target to look from this direction, the up axis on top; along that axis as set_view() does.
    void look_along(const Eigen::Vector3d& direction);
    /// Turns about the target to look from this direction (any length but 0) with `top` on top where possible.
    void look_from(const Eigen::Vector3d& direction, const Eigen::Vector3d& top);

    /// From the eye through the cursor.
    Ray ray(const Eigen::Vector2d& cursor, const Viewport& viewport) const;
    ProjectedPoint project(const Eigen::Vector3d& point, const Viewport& viewport) const;
    /// The point seen at `pixel` at this depth along the viewing direction [L].
    Eigen::Vector3d unproject(const Eigen::Vector2d& pixel, double depth, const Viewport& viewport) const;
    /// World displacement, parallel to the screen, that moves `anchor` on the screen by `to` - `from`: it stays
    /// exactly under the cursor that drags it. `anchor` must be in front of the eye.
    Eigen::Vector3d drag_in_plane(const Eigen::Vector3d& anchor, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                  const Viewport& viewport) const;
    /// Length of one pixel at this depth [L].
    double pixel_size(double depth, const Viewport& viewport) const;

private:
    Eigen::Vector3d eye_direction(const Eigen::Vector2d& pixel, const Viewport& viewport) const;
    double slope() const;
    double slope_per_pixel(const Viewport& viewport) const { return 2.0 * slope() / viewport.height; }
    double eye_distance() const { return remoteness() * pose_.distance; }

    CameraPose pose_;
    Projection kind_ = Projection::perspective;
    SceneFrame scene_;
    Eigen::Vector3d up_axis_ = Eigen::Vector3d::UnitZ();
};

/// The other one.
inline void toggle_projection(Camera& camera) {
    camera.set_projection_kind(camera.projection_kind() == Projection::perspective ? Projection::orthographic
                                                                                   : Projection::perspective);
}

}  // namespace elastolab
