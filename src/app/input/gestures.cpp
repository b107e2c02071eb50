#include "app/input/gestures.hpp"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>

#include "render/drawing/axes_gizmo.hpp"

namespace elastolab {

namespace {

constexpr double kDoubleClickSeconds = 0.35;
constexpr double kZoomStep = 1.15;      ///< for a notch of the wheel
constexpr double kDragZoom = 4.0;       ///< logarithm of the zoom by a drag over the height of the viewport
constexpr double kFingerPixels = 24.0;  ///< that two fingers move the view by, for a notch of the wheel
constexpr double kSpringSeconds = 0.25;

Gestures::Action action_of(ViewDrag drag) {
    if (drag == ViewDrag::zoom) return Gestures::Action::zoom;
    return drag == ViewDrag::pan ? Gestures::Action::pan : Gestures::Action::orbit;
}

/// False for vertices inside the body: they show where it is cut open, and cannot be grabbed.
bool is_on_surface(const GestureContext& context, int vertex) { return vertex < context.scene.mesh().n_vertices(); }

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
            move(context);
            break;
        case InputEvent::Kind::button:
            if (event.pressed && action_ == Action::none) press(event, context);
            if (!event.pressed && event.code == button_) release(context);
            break;
        case InputEvent::Kind::scroll:
            scroll(event, context);
            break;
        case InputEvent::Kind::key:
            std::erase(held_keys_, event.code);
            if (event.pressed) held_keys_.push_back(event.code);
            if (pulling() && event.pressed && event.code == GLFW_KEY_DELETE)
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
        action_ = action_of(view_drag(context.tools.navigation, event.code, event.modifiers));
        return;
    }
    if (press_axes(context, *target)) return;
    hold_ = shifted ? Hold::free : Hold::fix;
    if (context.tools.tool == Tool::box) {
        action_ = Action::box;
        return;
    }
    const bool brushes = context.tools.tool == Tool::brush || context.tools.tool == Tool::pressure;
    if (!brushes && press_arrow(context, *target)) return;
    if (press_gizmo(context, *target)) return;
    const std::optional<PickHit> hit = hit_in(context, *target);
    if (hit && is_on_surface(context, hit->vertex))
        press_body(context, *hit);
    else
        action_ = action_of(view_drag(context.tools.navigation, event.code, event.modifiers));
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

void Gestures::press_body(GestureContext& context, const PickHit& hit) {
    if (context.tools.tool == Tool::brush || context.tools.tool == Tool::pressure) {
        action_ = Action::paint;
        painted_.clear();
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
        const std::vector<int> patch = free_patch(context, hit.vertex);
        begin_pull(context, context.scene.add_handle(patch), Grabbed::new_handle, hit);
    }
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

void Gestures::move_view(GestureContext& context, const Eigen::Vector2d& before) {
    const Viewport& viewport = context.targets[target_].viewport;
    const Eigen::Vector2d d = cursor_ - before;
    if (action_ == Action::orbit) context.camera.orbit(d.x(), d.y(), viewport);
    if (action_ == Action::pan) context.camera.pan(before, cursor_, viewport);
    if (action_ == Action::zoom)
        context.camera.zoom_to(press_cursor_, std::exp(-kDragZoom * d.y() / viewport.height),
                               context.camera.pose().target, viewport);
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
    if (!hit || !is_on_surface(context, hit->vertex)) return;
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
            scroll_zoom(event.cursor.y(), context, *target);
            break;
    }
    if (pulling()) set_baseline(context);
    if (load_drag_ && !gizmo_drag_) set_load_baseline(context);
}

void Gestures::scroll_zoom(double notches, GestureContext& context, const PointingTarget& target) {
    const std::optional<PickHit> hit = hit_in(context, target);
    const Eigen::Vector3d anchor = hit ? hit->point : context.camera.pose().target;
    context.camera.zoom_to(cursor_, std::pow(kZoomStep, notches), anchor, target.viewport);
}

void Gestures::paint(GestureContext& context) {
    if (target_ >= context.targets.size()) return;
    const PointingTarget& target = context.targets[target_];
    std::vector<int> vertices = vertices_in_brush(context.camera, target.viewport, cursor_, context.tools.brush_pixels,
                                                  *target.positions, *target.triangles, Reach::visible);
    if (context.tools.tool == Tool::pressure)
        paint_pressure(context, std::move(vertices));
    else
        fix_or_free(context, std::move(vertices), hold_);
}

/// Fixes or frees these vertices, except those inside the body, in the selected set.
void Gestures::fix_or_free(const GestureContext& context, std::vector<int> vertices, Hold hold) {
    std::erase_if(vertices, [&](int v) { return !is_on_surface(context, v); });
    LiveScene& scene = context.scene;
    const bool selected = selected_fixed_ >= 0 && selected_fixed_ <= scene.n_fixed_sets();
    const int n_before = scene.n_fixed_sets();
    if (hold == Hold::free)
        scene.unfix(vertices, selected ? selected_fixed_ : LiveScene::kFixed);
    else if (selected)
        scene.fix(vertices, selected_fixed_);
    else
        scene.fix(vertices);
    // The selected set has lost its last vertex, and its number is another's now.
    if (selected && scene.n_fixed_sets() < n_before) selected_fixed_ = scene.n_fixed_sets();
}

void Gestures::toggle_fixed(GestureContext& context, int vertex) {
    const LiveScene& scene = context.scene;
    const int set = scene.fixed_set_of(vertex);
    if (set >= 0 && selected_fixed_ >= 0 && set != selected_fixed_)
        hint_ = "This vertex belongs to the fixed set \"" + scene.fixed_name(set) + "\". Select that one to free it.";
    fix_or_free(context, {vertex}, set >= 0 ? Hold::free : Hold::fix);
}

void Gestures::end_box(GestureContext& context) {
    if (!dragged_ || target_ >= context.targets.size()) return;
    const PointingTarget& target = context.targets[target_];
    fix_or_free(context,
                vertices_in_rectangle(context.camera, target.viewport, press_cursor_, cursor_, *target.positions,
                                      *target.triangles, context.tools.box_reach),
                hold_);
    context.scene.commit();
}

std::optional<std::pair<Eigen::Vector2d, Eigen::Vector2d>> Gestures::box() const {
    if (action_ != Action::box || !dragged_) return std::nullopt;
    return std::pair(press_cursor_, cursor_);
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
    context.scene.set_motion(spring_->handle, part_of(spring_->from, (1.0 - t) * (1.0 - t), rest));
    return true;
}

void Gestures::end_spring(GestureContext& context) {
    if (!spring_) return;
    context.scene.remove_handle(spring_->handle);
    context.scene.commit();
    spring_.reset();
}

void Gestures::finish(GestureContext& context) {
    if (action_ == Action::pull) end_pull(context);
    if (action_ == Action::paint) context.scene.commit();
    if (load_drag_) end_load(context);
    gizmo_drag_.reset();
    action_ = Action::none;
    button_ = -1;
    end_spring(context);
    selected_ = std::min(selected_, context.scene.n_handles() - 1);
    selected_fixed_ = std::min(selected_fixed_, context.scene.n_fixed_sets());
    if (selected_load_ && *selected_load_ >= context.scene.n_loads()) select_load(std::nullopt);
    hover_ = {};
}

void Gestures::reset() { *this = Gestures(); }

}  // namespace elastolab
