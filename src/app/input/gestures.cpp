#include "app/input/gestures.hpp"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <utility>

namespace elastolab {

namespace {

constexpr double kDoubleClickSeconds = 0.35;

/// What a press at this free vertex takes hold of.
std::vector<int> free_patch(const GestureContext& context, int vertex) {
    return patch_around(context.scene.mesh(), context.graph, vertex, context.tools.patch_radius,
                        [&](int v) { return context.scene.owner(v) == LiveScene::kNobody; });
}

}  // namespace

void Gestures::handle(const InputEvent& event, GestureContext& context) {
    modifiers_ = event.modifiers;
    switch (event.kind) {
        case InputEvent::Kind::cursor:
            cursor_ = event.cursor;
            fingers_target_ = -1;
            move(context);
            break;
        case InputEvent::Kind::button:
            if (event.pressed && action_ == Action::none) press(event, context);
            if (!event.pressed && event.code == button_) release(context);
            break;
        case InputEvent::Kind::scroll:
            scroll(event, context);
            break;
        case InputEvent::Kind::fingers:
            move_by_fingers(event, context);
            break;
        case InputEvent::Kind::key:
            std::erase(held_keys_, event.code);
            if (event.pressed) held_keys_.push_back(event.code);
            if (event.pressed && event.code == GLFW_KEY_ESCAPE && edits())
                take_back(context);
            else if (pulling() && event.pressed && event.code == GLFW_KEY_DELETE)
                remove_pulled(context);
            else if (action_ == Action::load && event.pressed && event.code == GLFW_KEY_DELETE)
                remove_dragged_load(context);
            else if (action_ == Action::load)
                drag_load(context);
            else if (pulling())
                pull(context);
            break;
        case InputEvent::Kind::focus:
            if (event.code == 0) held_keys_.clear();
            break;
        case InputEvent::Kind::text:
            break;
    }
}

/// As if the button had never been pressed.
void Gestures::take_back(GestureContext& context) {
    context.scene.take_back();
    const bool made_handle = action_ == Action::pull && pull_.grabbed == Grabbed::new_handle;
    if (made_handle) selected_ = -1;
    if (load_drag_ && load_drag_->is_new) {
        select_load(std::nullopt);
        select_handle(load_drag_->handle_before);
    }
    load_drag_.reset();
    gizmo_drag_.reset();
    painted_.clear();
    keep_selection_within(context.scene);
    action_ = Action::blocked;  // until the button is let go
}

const PointingTarget* Gestures::target_at(const GestureContext& context) const {
    for (const PointingTarget& target : context.targets)
        if (target.viewport.contains(cursor_)) return &target;
    return nullptr;
}

std::optional<PickHit> Gestures::hit_in(const GestureContext& context, const PointingTarget& target) const {
    return pick(context.camera, target.viewport, cursor_, *target.positions, *target.triangles);
}

bool Gestures::is_double_click(const InputEvent& event) {
    const bool result = event.code == GLFW_MOUSE_BUTTON_LEFT && last_press_seconds_ >= 0.0 &&
                        event.seconds - last_press_seconds_ < kDoubleClickSeconds &&
                        (cursor_ - last_press_).norm() < kClickPixels;
    last_press_seconds_ = result ? -1.0 : event.seconds;
    last_press_ = cursor_;
    return result;
}

void Gestures::press(const InputEvent& event, GestureContext& context) {
    const PointingTarget* target = target_at(context);
    if (target == nullptr) return;
    hint_.clear();
    end_spring(context);
    target_ = static_cast<std::size_t>(target - context.targets.data());
    button_ = event.code;
    press_cursor_ = cursor_;
    dragged_ = false;
    if (is_double_click(event)) {
        frame_requested_ = true;
        return;
    }
    const bool shifted = (event.modifiers & GLFW_MOD_SHIFT) != 0;
    if (event.code != GLFW_MOUSE_BUTTON_LEFT) {
        press_view(event, context);
        return;
    }
    if (press_axes(context, *target)) return;
    hold_ = shifted ? Hold::free : Hold::fix;
    if (context.tools.tool == Tool::box) {
        action_ = Action::box;
        return;
    }
    if (press_arrow(context, *target)) return;
    if (press_gizmo(context, *target)) return;
    const std::optional<PickHit> hit = hit_in(context, *target);
    if (hit && context.is_on_surface(hit->vertex))
        press_body(context, *hit);
    else
        press_view(event, context);
}

void Gestures::press_body(GestureContext& context, const PickHit& hit) {
    if (context.tools.tool == Tool::brush || context.tools.tool == Tool::pressure) {
        action_ = Action::paint;
        painted_.clear();
        painted_to_ = press_cursor_;
        return;
    }
    if (context.tools.tool == Tool::force) return press_force(context, hit);
    if (context.tools.tool == Tool::probe) {
        action_ = Action::orbit;
        return;
    }
    const int owner = context.scene.owner(hit.vertex);
    if (owner == LiveScene::kFixed) {
        select_fixed(context.scene.fixed_set_of(hit.vertex));
        hint_ = "This vertex is fixed. Free it with the brush (B) and Shift.";
        action_ = Action::blocked;  // turning the view would look as if the body had been pulled
    } else if (owner != LiveScene::kNobody) {
        begin_pull(context, owner, Grabbed::present_handle, hit);
    } else {
        begin_pull(context, add_handle_in_place(context, free_patch(context, hit.vertex)), Grabbed::new_handle, hit);
    }
}

/// Where its vertices are shown, so that nothing moves before the mouse does.
int Gestures::add_handle_in_place(GestureContext& context, const std::vector<int>& patch) {
    const int handle = context.scene.add_handle(patch);
    const Positions rest = context.scene.rest_positions(handle);
    const std::span<const int> own = context.scene.vertices(handle);
    const Positions moved =
        (*context.targets[target_].positions)(Eigen::all, std::vector<int>(own.begin(), own.end())) - rest;
    if (!moved.isZero(0.0) && context.display.deformation_scale > 0.0)
        context.scene.set_motion(handle, motion_to(rest, rest + moved / context.display.deformation_scale));
    return handle;
}

void Gestures::release(GestureContext& context) {
    const Action ended = std::exchange(action_, Action::none);
    button_ = -1;
    if (ended == Action::pull) end_pull(context);
    if (ended == Action::load && load_drag_) end_load(context);
    gizmo_drag_.reset();
    if (ended == Action::box) end_box(context);
    if (ended == Action::orbit && context.tools.tool == Tool::probe && !dragged_ && hover_.vertex >= 0)
        probed_ = hover_.vertex;
    if (ended == Action::paint) {
        if (context.tools.tool == Tool::pressure)
            paint(context);
        else if (!dragged_ && hover_.vertex >= 0)
            toggle_fixed(context, hover_.vertex);
        context.scene.commit();
    }
    point(context);
}

void Gestures::move(GestureContext& context) {
    const Eigen::Vector2d before = std::exchange(last_cursor_, cursor_);
    if (action_ == Action::none) {
        point(context);
        return;
    }
    if (target_ >= context.targets.size()) return;
    dragged_ = dragged_ || (cursor_ - press_cursor_).norm() >= kClickPixels;
    move_view(context, before);
    if (action_ == Action::pull) pull(context);
    if (action_ == Action::plane) move_plane(context);
    if (action_ == Action::load && load_drag_) drag_load(context);
    if (action_ == Action::paint && dragged_) paint(context);
}

void Gestures::point(GestureContext& context) {
    hover_ = {};
    const PointingTarget* target = target_at(context);
    if (target == nullptr) return;
    if (context.tools.tool != Tool::brush && context.tools.tool != Tool::pressure)
        hover_.load = arrow_at(context, *target);
    if (hover_.load) return;
    for (const Gizmo& gizmo : context.gizmos) {
        if (const auto part = part_at(gizmo, context.camera, target->viewport, cursor_)) {
            hover_.part = {gizmo.handle, *part};
            return;
        }
    }
    const std::optional<PickHit> hit = hit_in(context, *target);
    if (!hit || !context.is_on_surface(hit->vertex)) return;
    hover_.vertex = hit->vertex;
    if (context.tools.tool != Tool::pull) return;
    const int owner = context.scene.owner(hit->vertex);
    if (owner >= 0) {
        const std::span<const int> vertices = context.scene.vertices(owner);
        hover_.patch.assign(vertices.begin(), vertices.end());
    } else if (owner == LiveScene::kNobody) {
        hover_.patch = free_patch(context, hit->vertex);
    }
}

void Gestures::finish(GestureContext& context) {
    if (action_ == Action::pull) end_pull(context);
    if (action_ == Action::paint) context.scene.commit();
    if (load_drag_) end_load(context);
    gizmo_drag_.reset();
    action_ = Action::none;
    button_ = -1;
    end_spring(context);
    keep_selection_within(context.scene);
    hover_ = {};
    hint_.clear();  // of what the edit may have taken back
}

/// What was selected may be gone.
void Gestures::keep_selection_within(const LiveScene& scene) {
    selected_ = std::min(selected_, scene.n_handles() - 1);
    selected_fixed_ = std::min(selected_fixed_, scene.n_fixed_sets());
    if (selected_load_ && *selected_load_ >= scene.n_loads()) select_load(std::nullopt);
}

void Gestures::reset() { *this = Gestures(); }

}  // namespace elastolab
