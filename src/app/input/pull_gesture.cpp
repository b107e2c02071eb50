// Pulling: what Gestures does from the grab of a handle until it is let go.
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>

#include "app/input/gestures.hpp"

namespace elastolab {

namespace {

constexpr double kTurnPerPixel = 0.01;    ///< [radians]
constexpr double kScalePerPixel = 0.005;  ///< of the logarithm

/// How far along the line (point, direction) the cursor has dragged a point of it: where the line comes nearest to the
/// ray of the cursor. Directions that point at the eye give nothing to hold on to: 0.
double along_line(const Ray& ray, const Eigen::Vector3d& point, const Eigen::Vector3d& direction) {
    const double cosine = ray.direction.dot(direction);
    const double denominator = 1.0 - cosine * cosine;
    if (denominator < 1e-4) return 0.0;
    const Eigen::Vector3d to_point = point - ray.origin;
    return (cosine * ray.direction.dot(to_point) - direction.dot(to_point)) / denominator;
}

Eigen::Vector3d triangle_normal(const PointingTarget& target, int triangle) {
    const Positions& x = *target.positions;
    const Eigen::Vector3i t = target.triangles->col(triangle);
    return (x.col(t[1]) - x.col(t[0])).cross(x.col(t[2]) - x.col(t[0])).stableNormalized();
}

}  // namespace

void Gestures::begin_pull(GestureContext& context, int handle, Grabbed grabbed, const PickHit& hit) {
    action_ = Action::pull;
    selected_ = handle;
    pull_ = {};
    pull_.handle = handle;
    pull_.grabbed = grabbed;
    pull_.vertex = hit.vertex;
    if (hit.triangle >= 0) pull_.normal = triangle_normal(context.targets[target_], hit.triangle);
    pull_.motion = context.scene.document().handles[static_cast<std::size_t>(handle)].motion;
    pull_.place = context.targets[target_].positions->col(hit.vertex);
    set_baseline(context);
}

/// What is shown may lag behind while a new handle is prepared: the place follows from the motion since the last one.
void Gestures::set_baseline(GestureContext& context) {
    pull_.mode = pull_mode(context.tools);
    pull_.cursor = cursor_;
    const Eigen::Vector3d x = context.scene.mesh().vertices.col(pull_.vertex);
    const Motion& motion = context.scene.document().handles[static_cast<std::size_t>(pull_.handle)].motion;
    pull_.place += context.deformation_scale * (mean_displacement(motion, x) - mean_displacement(pull_.motion, x));
    pull_.motion = motion;
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
    if (pull_.mode == PullMode::plane)
        return context.camera.drag_in_plane(pull_.place, pull_.cursor, cursor_, viewport);
    Eigen::Vector3d direction = pull_.normal;
    if (pull_.mode != PullMode::normal)
        direction = Eigen::Vector3d::Unit(static_cast<int>(pull_.mode) - static_cast<int>(PullMode::axis_x));
    return direction * (along_line(context.camera.ray(cursor_, viewport), pull_.place, direction) -
                        along_line(context.camera.ray(pull_.cursor, viewport), pull_.place, direction));
}

void Gestures::pull(GestureContext& context) {
    if (pull_mode(context.tools) != pull_.mode) set_baseline(context);
    if (!pull_.moved && (cursor_ - press_cursor_).norm() < kClickPixels) return;
    pull_.moved = true;
    const std::span<const int> vertices = context.scene.vertices(pull_.handle);
    if (pull_.mode != PullMode::turn && pull_.mode != PullMode::scale) {
        const Eigen::Vector3d shift = pull_shift(context) / context.deformation_scale;
        context.scene.set_motion(pull_.handle, translated(pull_.motion, shift));
        return;
    }
    const Eigen::Vector2d d = cursor_ - pull_.cursor;
    Eigen::Matrix3d map = std::exp(-kScalePerPixel * d.y()) * Eigen::Matrix3d::Identity();
    if (pull_.mode == PullMode::turn)
        map = (Eigen::AngleAxisd(kTurnPerPixel * d.x(), context.camera.up()) *
               Eigen::AngleAxisd(kTurnPerPixel * d.y(), context.camera.right()))
                  .toRotationMatrix();
    const Positions rest =
        context.scene.mesh().vertices(Eigen::all, std::vector<int>(vertices.begin(), vertices.end()));
    const Eigen::Vector3d center = rest.rowwise().mean() + mean_displacement(pull_.motion, rest);
    context.scene.set_motion(pull_.handle, transformed(pull_.motion, map, center, rest));
}

void Gestures::end_pull(GestureContext& context) {
    if (!pull_.moved) {
        if (pull_.grabbed == Grabbed::new_handle) {
            context.scene.remove_handle(pull_.handle);  // a click pulls nothing
            selected_ = -1;
        }
    } else if (context.tools.release == Release::spring_back) {
        spring_ = Spring{pull_.handle, context.scene.document().handles[static_cast<std::size_t>(pull_.handle)].motion};
        selected_ = -1;
    } else {
        context.scene.commit();
    }
}

/// Of the person's, or made by this press: in either case nothing of it is left.
void Gestures::remove_pulled(GestureContext& context) {
    context.scene.remove_handle(pull_.handle);
    context.scene.commit();
    selected_ = -1;
    action_ = Action::blocked;  // until the button is let go
}

}  // namespace elastolab
