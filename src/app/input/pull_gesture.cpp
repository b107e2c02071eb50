// Pulling: what Gestures does from the grab of a handle until it is let go.
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <utility>

#include "app/input/gestures.hpp"
#include "elasticity/rotation.hpp"

namespace elastolab {

namespace {

constexpr double kTurnPerPixel = 0.01;    ///< [radians]
constexpr double kScalePerPixel = 0.005;  ///< of the logarithm
constexpr double kSnapScale = 0.1;        ///< of the factor
constexpr double kSpringSeconds = 0.25;   ///< in which a handle springs back

Eigen::Vector3d triangle_normal(const PointingTarget& target, int triangle) {
    const Positions& x = *target.positions;
    const Eigen::Vector3i t = target.triangles->col(triangle);
    return (x.col(t[1]) - x.col(t[0])).cross(x.col(t[2]) - x.col(t[0])).stableNormalized();
}

/// A shift in round steps: along its line, or along each axis of the world where it has none.
Eigen::Vector3d in_steps(const Eigen::Vector3d& shift, bool along_a_line, double step) {
    if (!along_a_line) return shift.unaryExpr([&](double x) { return snapped(x, step); });
    const double length = shift.stableNorm();
    return length > 0.0 ? Eigen::Vector3d(shift * (snapped(length, step) / length)) : shift;
}

}  // namespace

void Gestures::begin_pull(GestureContext& context, int handle, Grabbed grabbed, const PickHit& hit) {
    action_ = Action::pull;
    select_handle(handle);
    pull_ = {};
    pull_.handle = handle;
    pull_.grabbed = grabbed;
    pull_.vertex = hit.vertex;
    if (hit.triangle >= 0) pull_.normal = triangle_normal(context.targets[target_], hit.triangle);
    pull_.motion = context.scene.document().handles[static_cast<std::size_t>(handle)].motion;
    if (grabbed == Grabbed::new_handle) pull_.before = pull_.motion;
    pull_.place = context.targets[target_].positions->col(hit.vertex);
    const std::optional<GripForce>& force = context.scene.document().handles[static_cast<std::size_t>(handle)].force;
    const bool gives_way = grabbed == Grabbed::new_handle || force.has_value();
    pull_.had_force = force.has_value();
    if (force) pull_.moment = force->moment;
    if (context.tools.pull_mode == PullMode::spring && gives_way) pull_.spring = context.tools.spring;
    set_baseline(context);
}

/// What is shown may lag behind while a new handle is prepared: the place is moved on by the motion since the baseline
/// before.
void Gestures::set_baseline(GestureContext& context) {
    pull_.mode = pull_mode(context.tools);
    pull_.cursor = cursor_;
    for (const Gizmo& gizmo : context.gizmos)
        if (gizmo_drag_ && gizmo.handle == pull_.handle) gizmo_drag_ = GizmoDrag{gizmo, gizmo_drag_->part, cursor_};
    const Eigen::Vector3d x = context.scene.mesh().vertices.col(pull_.vertex);
    const Motion& motion = context.scene.document().handles[static_cast<std::size_t>(pull_.handle)].motion;
    pull_.place +=
        context.display.deformation_scale * (mean_displacement(motion, x) - mean_displacement(pull_.motion, x));
    pull_.motion = motion;
    const GripForce force =
        context.scene.document().handles[static_cast<std::size_t>(pull_.handle)].force.value_or(GripForce{});
    pull_.tension = force.force + (pull_.spring - force.spring) *
                                      mean_displacement(motion, context.scene.rest_positions(pull_.handle));
}

PullMode Gestures::pull_mode(const ToolSettings& tools) const {
    const auto held = [&](int key) { return std::find(held_keys_.begin(), held_keys_.end(), key) != held_keys_.end(); };
    if (held(GLFW_KEY_X)) return PullMode::axis_x;
    if (held(GLFW_KEY_Y)) return PullMode::axis_y;
    if (held(GLFW_KEY_Z)) return PullMode::axis_z;
    if (held(GLFW_KEY_R) || (modifiers_ & GLFW_MOD_CONTROL) != 0) return PullMode::turn;
    if (held(GLFW_KEY_S) || (modifiers_ & GLFW_MOD_ALT) != 0) return PullMode::scale;
    if ((modifiers_ & GLFW_MOD_SHIFT) != 0) return PullMode::normal;
    return tools.pull_mode;
}

/// How far the vertex is to go, as shown.
Eigen::Vector3d Gestures::pull_shift(const GestureContext& context) const {
    const Viewport& viewport = context.targets[target_].viewport;
    const bool in_plane = pull_.mode == PullMode::plane || pull_.mode == PullMode::spring;
    if (in_plane || (pull_.spring > 0.0 && (pull_.mode == PullMode::turn || pull_.mode == PullMode::scale)))
        return context.camera.drag_in_plane(pull_.place, pull_.cursor, cursor_, viewport);
    Eigen::Vector3d direction = pull_.normal;
    if (pull_.mode != PullMode::normal)
        direction = Eigen::Vector3d::Unit(static_cast<int>(pull_.mode) - static_cast<int>(PullMode::axis_x));
    return direction * dragged_along(context.camera, viewport, pull_.place, direction, pull_.cursor, cursor_);
}

void Gestures::pull(GestureContext& context) {
    if (!gizmo_drag_ && pull_mode(context.tools) != pull_.mode) set_baseline(context);
    if (!pull_.moved && (cursor_ - press_cursor_).norm() < kClickPixels) return;
    if (!std::exchange(pull_.moved, true) && pull_.had_force && (gizmo_drag_ || pull_.spring <= 0.0))
        hint_ =
            "A force moved this handle; now you do. Undo (Ctrl+Z) brings the force back. To change it, type it in the "
            "panel or pull with a spring.";
    if (gizmo_drag_) return pull_by_gizmo(context);
    if (pull_.spring > 0.0) return pull_by_spring(context);
    if (pull_.mode != PullMode::turn && pull_.mode != PullMode::scale) {
        Eigen::Vector3d shift = pull_shift(context) / context.display.deformation_scale;
        const bool along_a_line = pull_.mode != PullMode::plane && pull_.mode != PullMode::spring;
        if (context.tools.snap) shift = in_steps(shift, along_a_line, snap_length(context.scene));
        context.scene.set_motion(pull_.handle, translated(pull_.motion, shift));
        return;
    }
    const Eigen::Vector2d d = cursor_ - pull_.cursor;
    if (pull_.mode == PullMode::scale) {
        double factor = std::exp(-kScalePerPixel * d.y());
        if (context.tools.snap) factor = std::max(kSnapScale, snapped(factor, kSnapScale));
        const Positions rest = context.scene.rest_positions(pull_.handle);
        return context.scene.set_motion(
            pull_.handle, transformed(pull_.motion, factor * Eigen::Matrix3d::Identity(), pulled_center(rest), rest));
    }
    const Eigen::Vector2d angles = (kTurnPerPixel * d).unaryExpr([&](double angle) {
        return context.tools.snap ? snapped(angle, kSnapAngle) : angle;
    });
    const Eigen::Vector3d up = context.camera.up(), right = context.camera.right();
    const Eigen::AngleAxisd about_up(angles.x(), up), about_right(angles.y(), right);
    turn_pulled(context,
                rotation_vector((about_up * about_right).toRotationMatrix(), angles.x() * up + angles.y() * right));
}

/// The far end of the spring follows the cursor; where the patch goes, the equilibrium says.
void Gestures::pull_by_spring(GestureContext& context) {
    const Eigen::Vector3d shift = pull_shift(context) / context.display.deformation_scale;
    context.scene.set_force(
        pull_.handle,
        GripForce{.force = pull_.tension + pull_.spring * shift, .moment = pull_.moment, .spring = pull_.spring});
}

std::optional<Gestures::SpringPull> Gestures::spring_pull(const LiveScene& scene) const {
    if (pull_.spring <= 0.0 || pull_.handle < 0 || pull_.handle >= scene.n_handles()) return std::nullopt;
    const Handle& handle = scene.document().handles[static_cast<std::size_t>(pull_.handle)];
    if (!handle.force) return std::nullopt;
    return SpringPull{pull_.vertex,
                      handle.force->force -
                          handle.force->spring * mean_displacement(handle.motion, scene.rest_positions(pull_.handle))};
}

/// Where the middle of the pulled handle was at the baseline.
Eigen::Vector3d Gestures::pulled_center(const Positions& rest) const {
    return rest.rowwise().mean() + mean_displacement(pull_.motion, rest);
}

/// Turns the handle about its middle. `turn`: along the axis, as long as the angle [radians].
void Gestures::turn_pulled(GestureContext& context, const Eigen::Vector3d& turn) {
    const Positions rest = context.scene.rest_positions(pull_.handle);
    context.scene.set_motion(pull_.handle, turned(pull_.motion, turn, pulled_center(rest), rest));
}

void Gestures::end_pull(GestureContext& context) {
    const std::optional<SpringPull> sprung = spring_pull(context.scene);
    if (!pull_.moved) {
        if (pull_.grabbed == Grabbed::new_handle) {
            context.scene.remove_handle(pull_.handle);  // a click pulls nothing
            selected_ = -1;
        }
    } else if (context.tools.release == Release::spring_back && !gizmo_drag_) {
        const Motion& now = context.scene.document().handles[static_cast<std::size_t>(pull_.handle)].motion;
        spring_.emplace(Spring{pull_.handle, now, pull_.before});
        selected_ = -1;
    } else {
        if (sprung)  // it stays where it is
            context.scene.set_force(pull_.handle, GripForce{.force = sprung->force, .moment = pull_.moment});
        context.scene.commit();
    }
}

/// To rest, or to where the body held the patch before it was pulled.
Motion Gestures::on_the_way_back(const Spring& spring, double part, const Positions& rest) {
    if (spring.to == Motion(AffineMotion{})) return part_of(spring.from, part, rest);
    const Eigen::Matrix3Xd to = displacements(spring.to, rest), left = part * (displacements(spring.from, rest) - to);
    VertexMotion between;
    for (Eigen::Index i = 0; i < rest.cols(); ++i) between.displacements.emplace_back(to.col(i) + left.col(i));
    return between;
}

bool Gestures::animate(double now, GestureContext& context) {
    if (!spring_) return false;
    if (spring_->begin < 0.0) spring_->begin = now;
    const double t = (now - spring_->begin) / kSpringSeconds;
    if (t >= 1.0) {
        end_spring(context);
        return false;
    }
    const Positions rest = context.scene.rest_positions(spring_->handle);
    context.scene.set_motion(spring_->handle, on_the_way_back(*spring_, (1.0 - t) * (1.0 - t), rest));
    return true;
}

void Gestures::end_spring(GestureContext& context) {
    if (!spring_) return;
    context.scene.remove_handle(spring_->handle);
    context.scene.commit();
    spring_.reset();
}

/// Whether the handle was there before or was made by this press, nothing of it is left.
void Gestures::remove_pulled(GestureContext& context) {
    context.scene.remove_handle(pull_.handle);
    context.scene.commit();
    selected_ = -1;
    action_ = Action::blocked;  // until the button is let go
}

}  // namespace elastolab
