#include "app/input/gestures.hpp"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>

namespace elastolab {

namespace {

constexpr double kClickPixels = 3.0;  ///< a press that moved no further is a click
constexpr double kDoubleClickSeconds = 0.35;
constexpr double kZoomStep = 1.15;        ///< for a notch of the wheel
constexpr double kTurnPerPixel = 0.01;    ///< [radians]
constexpr double kScalePerPixel = 0.005;  ///< of the logarithm
constexpr double kSpringSeconds = 0.25;

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

/// Not so of vertices inside the body, which show where it is cut open and cannot be grabbed.
bool is_on_surface(const GestureContext& context, int vertex) { return vertex < context.scene.mesh().n_vertices(); }

/// Fixes these vertices, those inside the body aside, or frees them.
void fix_or_free(const GestureContext& context, std::vector<int> vertices, bool free) {
    std::erase_if(vertices, [&](int v) { return !is_on_surface(context, v); });
    if (free)
        context.scene.unfix(vertices);
    else
        context.scene.fix(vertices);
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
            if (pulling()) pull(context);
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
    if (event.code != GLFW_MOUSE_BUTTON_LEFT) {
        action_ = Action::pan;
        return;
    }
    freeing_ = (event.modifiers & GLFW_MOD_SHIFT) != 0;
    if (context.tools.tool == Tool::box) {
        action_ = Action::box;
        return;
    }
    const std::optional<PickHit> hit = hit_in(context, *target);
    if (hit && is_on_surface(context, hit->vertex))
        press_body(context, hit->vertex, hit->triangle);
    else
        action_ = freeing_ ? Action::pan : Action::orbit;
}

void Gestures::press_body(GestureContext& context, int vertex, int triangle) {
    if (context.tools.tool == Tool::brush) {
        action_ = Action::paint;
        return;
    }
    const int owner = context.scene.owner(vertex);
    if (owner == LiveScene::kFixed) {
        hint_ = "This vertex is fixed. Free it with the brush (B) and Shift.";
        action_ = Action::orbit;
    } else if (owner != LiveScene::kNobody) {
        begin_pull(context, owner, false, vertex, triangle);
    } else {
        const std::vector<int> patch =
            patch_around(context.scene.mesh(), context.graph, vertex, context.tools.patch_radius);
        begin_pull(context, context.scene.add_handle(patch), true, vertex, triangle);
    }
}

void Gestures::begin_pull(GestureContext& context, int handle, bool created, int vertex, int triangle) {
    action_ = Action::pull;
    selected_ = handle;
    pull_ = {};
    pull_.handle = handle;
    pull_.created = created;
    pull_.vertex = vertex;
    if (triangle >= 0) pull_.normal = triangle_normal(context.targets[target_], triangle);
    pull_.motion = context.scene.document().handles[static_cast<std::size_t>(handle)].motion;
    pull_.place = context.targets[target_].positions->col(vertex);
    set_baseline(context);
}

/// What is shown may lag behind while a new handle is prepared: the place follows from the motion since the last one.
void Gestures::set_baseline(GestureContext& context) {
    pull_.mode = pull_mode();
    pull_.cursor = cursor_;
    const Eigen::Vector3d x = context.scene.mesh().vertices.col(pull_.vertex);
    const Motion& motion = context.scene.document().handles[static_cast<std::size_t>(pull_.handle)].motion;
    pull_.place += context.deformation_scale * (mean_displacement(motion, x) - mean_displacement(pull_.motion, x));
    pull_.motion = motion;
}

Gestures::PullMode Gestures::pull_mode() const {
    const auto held = [&](int key) { return std::find(held_keys_.begin(), held_keys_.end(), key) != held_keys_.end(); };
    if (held(GLFW_KEY_X)) return PullMode::axis_x;
    if (held(GLFW_KEY_Y)) return PullMode::axis_y;
    if (held(GLFW_KEY_Z)) return PullMode::axis_z;
    if (held(GLFW_KEY_R) || (modifiers_ & GLFW_MOD_CONTROL) != 0) return PullMode::turn;
    if (held(GLFW_KEY_S) || (modifiers_ & GLFW_MOD_ALT) != 0) return PullMode::scale;
    if ((modifiers_ & GLFW_MOD_SHIFT) != 0) return PullMode::normal;
    return PullMode::plane;
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
    if (pull_mode() != pull_.mode) set_baseline(context);
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
        if (pull_.created) {
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

void Gestures::release(GestureContext& context) {
    const Action ended = std::exchange(action_, Action::none);
    button_ = -1;
    if (ended == Action::pull) end_pull(context);
    if (ended == Action::box) end_box(context);
    if (ended == Action::paint) {
        if (!dragged_ && hover_.vertex >= 0) toggle_fixed(context, hover_.vertex);
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
    const Viewport& viewport = context.targets[target_].viewport;
    const Eigen::Vector2d d = cursor_ - before;
    if (action_ == Action::orbit) context.camera.orbit(d.x(), d.y(), viewport);
    if (action_ == Action::pan) context.camera.pan(before, cursor_, viewport);
    if (action_ == Action::pull) pull(context);
    if (action_ == Action::paint && dragged_) paint(context);
}

void Gestures::point(GestureContext& context) {
    hover_ = {};
    const PointingTarget* target = target_at(context);
    if (target == nullptr) return;
    const std::optional<PickHit> hit = hit_in(context, *target);
    if (!hit || !is_on_surface(context, hit->vertex)) return;
    hover_.vertex = hit->vertex;
    if (context.tools.tool != Tool::pull) return;
    const int owner = context.scene.owner(hit->vertex);
    if (owner >= 0) {
        const std::span<const int> vertices = context.scene.vertices(owner);
        hover_.patch.assign(vertices.begin(), vertices.end());
    } else if (owner == LiveScene::kNobody) {
        hover_.patch = patch_around(context.scene.mesh(), context.graph, hit->vertex, context.tools.patch_radius);
        std::erase_if(hover_.patch, [&](int v) { return context.scene.owner(v) != LiveScene::kNobody; });
    }
}

void Gestures::scroll(const InputEvent& event, GestureContext& context) {
    const PointingTarget* target = target_at(context);
    if (target == nullptr) return;
    const std::optional<PickHit> hit = hit_in(context, *target);
    const Eigen::Vector3d anchor = hit ? hit->point : context.camera.pose().target;
    context.camera.zoom_to(cursor_, std::pow(kZoomStep, event.cursor.y()), anchor, target->viewport);
    if (pulling()) set_baseline(context);
}

void Gestures::paint(GestureContext& context) {
    const PointingTarget& target = context.targets[target_];
    fix_or_free(context,
                vertices_in_brush(context.camera, target.viewport, cursor_, context.tools.brush_pixels,
                                  *target.positions, *target.triangles, Reach::visible),
                freeing_);
}

void Gestures::toggle_fixed(GestureContext& context, int vertex) {
    fix_or_free(context, {vertex}, context.scene.owner(vertex) == LiveScene::kFixed);
}

void Gestures::end_box(GestureContext& context) {
    if (!dragged_ || target_ >= context.targets.size()) return;
    const PointingTarget& target = context.targets[target_];
    fix_or_free(context,
                vertices_in_rectangle(context.camera, target.viewport, press_cursor_, cursor_, *target.positions,
                                      *target.triangles, context.tools.box_reach),
                freeing_);
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
    context.scene.set_motion(spring_->handle, scaled(spring_->from, (1.0 - t) * (1.0 - t)));
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
    action_ = Action::none;
    button_ = -1;
    end_spring(context);
    selected_ = std::min(selected_, context.scene.n_handles() - 1);
    hover_ = {};
}

void Gestures::reset() { *this = Gestures(); }

}  // namespace elastolab
