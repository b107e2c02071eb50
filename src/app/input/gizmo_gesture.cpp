// Gizmos: what Gestures does from the press on an arrow or a ring until it is let go.
#include <GLFW/glfw3.h>

#include <algorithm>
#include <numbers>

#include "app/input/gestures.hpp"

namespace elastolab {

bool Gestures::press_gizmo(GestureContext& context, const PointingTarget& target) {
    for (const Gizmo& gizmo : context.gizmos) {
        if (gizmo.handle >= context.scene.n_handles()) continue;  // removed in this frame
        const std::optional<GizmoPart> part = part_at(gizmo, context.camera, target.viewport, cursor_);
        if (!part) continue;
        if (gizmo.handle == Gizmo::kPlane) {
            plane_before_ = context.display;
            action_ = Action::plane;
        } else if (gizmo.handle == Gizmo::kGravity) {
            const auto gravity = std::find_if(context.load_arrows.begin(), context.load_arrows.end(),
                                              [](const LoadArrow& arrow) { return arrow.load == LiveScene::kGravity; });
            if (gravity == context.load_arrows.end()) continue;
            begin_load(context, *gravity, false);
        } else {
            begin_pull(context, gizmo.handle, Grabbed::present_handle,
                       {.vertex = context.scene.vertices(gizmo.handle).front()});
        }
        gizmo_drag_ = GizmoDrag{gizmo, *part, cursor_};
        hover_ = {.part = {{gizmo.handle, *part}}};
        return true;
    }
    return false;
}

bool Gestures::snaps(const ToolSettings& tools) const { return tools.snap || (modifiers_ & GLFW_MOD_CONTROL) != 0; }

/// How far the gizmo has been dragged. Rings add up the angles between places of the cursor, so that they can be turned
/// round and round.
double Gestures::gizmo_amount(const GestureContext& context) {
    const Viewport& viewport = context.targets[target_].viewport;
    GizmoDrag& drag = *gizmo_drag_;
    const bool moves = drag.part.kind == GizmoPart::Kind::arrow;
    const Eigen::Vector2d& begin = action_ == Action::pull ? pull_.cursor : press_cursor_;
    double amount = dragged(drag.gizmo, drag.part, context.camera, viewport, moves ? begin : drag.cursor, cursor_);
    drag.cursor = cursor_;
    if (!moves) amount = drag.turned += amount;
    if (moves && action_ == Action::pull) amount /= context.display.deformation_scale;
    if (!snaps(context.tools)) return amount;
    return snapped(amount, moves ? snap_length(context.scene) : kSnapAngle);
}

void Gestures::pull_by_gizmo(GestureContext& context) {
    const double amount = gizmo_drag_->amount = gizmo_amount(context);
    const Eigen::Vector3d axis = gizmo_drag_->gizmo.axes.col(gizmo_drag_->part.axis);
    if (gizmo_drag_->part.kind == GizmoPart::Kind::arrow)
        context.scene.set_motion(pull_.handle, translated(pull_.motion, amount * axis));
    else
        turn_pulled(context, amount * axis);
}

/// The plane of the cut: its place by the arrow, turn and tilt by the rings about their axes.
void Gestures::move_plane(GestureContext& context) {
    const double amount = gizmo_drag_->amount = gizmo_amount(context);
    DisplaySettings& display = context.display;
    if (gizmo_drag_->part.kind == GizmoPart::Kind::arrow) {
        const Eigen::RowVectorXd along = gizmo_drag_->gizmo.axes.col(0).transpose() * context.scene.mesh().vertices;
        const double extent = along.maxCoeff() - along.minCoeff();
        if (!(extent > 0.0)) return;  // a flat sheet
        display.cut.place = std::clamp(plane_before_.cut.place + amount / extent, 0.0, 1.0);
        return;
    }
    const bool turns = gizmo_drag_->part.axis == 1;
    double& angle = turns ? display.cut.turn : display.cut.tilt;
    const double before = turns ? plane_before_.cut.turn : plane_before_.cut.tilt;
    angle = std::clamp(before + amount * 180.0 / std::numbers::pi, -90.0, 90.0);
}

}  // namespace elastolab
