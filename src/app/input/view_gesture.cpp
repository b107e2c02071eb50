// The view: what Gestures does to the camera.
#include <cmath>

#include "app/input/gestures.hpp"
#include "render/drawing/axes_gizmo.hpp"

namespace elastolab {

namespace {

constexpr double kZoomStep = 1.15;      ///< for a notch of the wheel
constexpr double kDragZoom = 4.0;       ///< logarithm of the zoom by a drag over the height of the viewport
constexpr double kFingerPixels = 24.0;  ///< that two fingers move the view by, for a notch of the wheel

}  // namespace

void Gestures::press_view(const InputEvent& event, const GestureContext& context) {
    switch (view_drag(context.tools.navigation, event.code, event.modifiers)) {
        case ViewDrag::orbit:
            action_ = Action::orbit;
            break;
        case ViewDrag::pan:
            action_ = Action::pan;
            break;
        case ViewDrag::zoom:
            action_ = Action::zoom;
            break;
    }
}

/// Looks along the axis whose letter is pressed; from the other side where that is so already.
bool Gestures::press_axes(GestureContext& context, const PointingTarget& target) {
    Camera& camera = context.camera;
    const auto axis = AxesGizmo::axis_at(camera, AxesGizmo::place_in(target.viewport), cursor_);
    if (!axis) return false;
    const bool is_there = camera.backward()[*axis] > 1.0 - 1e-9;
    camera.look_along((is_there ? -1.0 : 1.0) * Eigen::Vector3d::Unit(*axis));
    action_ = Action::blocked;
    return true;
}

void Gestures::move_view(GestureContext& context, const Eigen::Vector2d& before) {
    const Viewport& viewport = context.targets[target_].viewport;
    const Eigen::Vector2d d = cursor_ - before;
    if (action_ == Action::orbit) context.camera.orbit(d.x(), d.y(), viewport);
    if (action_ == Action::pan) context.camera.pan(before, cursor_, viewport);
    if (action_ == Action::zoom)
        context.camera.zoom_to(press_cursor_, std::exp(-kDragZoom * d.y() / viewport.height),
                               context.camera.pose().target, viewport);
}

void Gestures::scroll(const InputEvent& event, GestureContext& context) {
    const PointingTarget* target = target_at(context);
    if (target == nullptr) return;
    const Eigen::Vector2d fingers = kFingerPixels * event.cursor;
    switch (view_scroll(context.tools.navigation, event.modifiers)) {
        case ViewDrag::orbit:
            context.camera.orbit(fingers.x(), fingers.y(), target->viewport);
            break;
        case ViewDrag::pan:
            context.camera.pan(cursor_, cursor_ + fingers, target->viewport);
            break;
        case ViewDrag::zoom:
            zoom(std::pow(kZoomStep, event.cursor.y()), context, *target);
            break;
    }
    keep_drags_in_view(context);
}

/// What they came down in keeps them until they are lifted.
const PointingTarget* Gestures::target_of_fingers(const GestureContext& context) {
    if (fingers_target_ < 0) {
        const PointingTarget* below = target_at(context);
        if (below == nullptr) return nullptr;
        fingers_target_ = below - context.targets.data();
    }
    return fingers_target_ < std::ssize(context.targets) ? context.targets.data() + fingers_target_ : nullptr;
}

/// Two move and zoom, three turn.
void Gestures::move_by_fingers(const InputEvent& event, GestureContext& context) {
    cursor_ = event.from;
    const PointingTarget* target = target_of_fingers(context);
    const Eigen::Vector2d d = event.cursor - event.from;
    if (target != nullptr && event.code > 2) context.camera.orbit(d.x(), d.y(), target->viewport);
    if (target != nullptr && event.code == 2) {
        context.camera.pan(event.from, event.cursor, target->viewport);
        cursor_ = event.cursor;
        zoom(event.zoom, context, *target);
    }
    cursor_ = event.cursor;
    if (target != nullptr) keep_drags_in_view(context);
}

/// What is dragged meanwhile goes on from where the cursor now points.
void Gestures::keep_drags_in_view(GestureContext& context) {
    if (pulling()) set_baseline(context);
    if (load_drag_ && !gizmo_drag_) set_load_baseline(context);
}

/// The point under the cursor stays there.
void Gestures::zoom(double factor, GestureContext& context, const PointingTarget& target) {
    const std::optional<PickHit> hit = hit_in(context, target);
    const Eigen::Vector3d anchor = hit ? hit->point : context.camera.pose().target;
    context.camera.zoom_to(cursor_, factor, anchor, target.viewport);
}

}  // namespace elastolab
