// Loads: what Gestures does from the press on an arrow or a patch until it is let go.
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <utility>

#include "app/input/gestures.hpp"
#include "mesh/numbering.hpp"
#include "render/drawing/legend.hpp"

namespace elastolab {

namespace {

constexpr double kArrowReach = 10.0;  ///< how near to an arrow's end the cursor must be [pixels]
constexpr double kSnapPart = 0.01;    ///< a step of snapping, of what a drag by the body's diagonal would be

/// A patch of whole triangles around a vertex, whatever holds it.
std::vector<int> loadable_patch(const GestureContext& context, int vertex) {
    const SurfaceMesh& mesh = context.scene.mesh();
    const double radius = std::max(context.tools.patch_radius, 1e-6 * context.scene.report().mean_edge);
    return patch_around(mesh, context.graph, vertex, radius, [](int) { return true; });
}

/// The force that acts on a triangle with these corners, the latest of several.
std::optional<int> force_on(const LiveScene& scene, const std::vector<int>& corners) {
    const auto has_all = [&](int triangle) {
        const auto own = scene.mesh().triangles.col(triangle);
        return std::all_of(corners.begin(), corners.end(), [&](int v) { return (own.array() == v).any(); });
    };
    for (int load = scene.n_loads() - 1; load >= 0; --load) {
        const AppliedLoad* applied = scene.applied_load(load);
        if (applied == nullptr || applied->kind != AppliedLoad::Kind::force) continue;
        if (std::any_of(applied->triangles.begin(), applied->triangles.end(), has_all)) return load;
    }
    return std::nullopt;
}

void set_vector(LiveScene& scene, int load, const Eigen::Vector3d& value) {
    if (load == LiveScene::kGravity) return scene.set_gravity(value, scene.document().density);
    if (std::holds_alternative<TractionLoad>(scene.document().loads[static_cast<std::size_t>(load)].value))
        scene.set_load(load, TractionLoad{value});
    else
        scene.set_load(load, ForceLoad{value});
}

}  // namespace

std::optional<int> Gestures::arrow_at(const GestureContext& context, const PointingTarget& target) const {
    std::optional<int> nearest;
    double least = kArrowReach;
    for (const LoadArrow& arrow : context.load_arrows) {
        const ProjectedPoint end = context.camera.project(arrow.end, target.viewport);
        if (end.depth <= 0.0 || (arrow.end - arrow.place).norm() == 0.0) continue;
        const double distance = (end.pixel - cursor_).norm();
        if (distance >= least) continue;
        least = distance;
        nearest = arrow.load;
    }
    return nearest;
}

bool Gestures::press_arrow(GestureContext& context, const PointingTarget& target) {
    const std::optional<int> load = arrow_at(context, target);
    if (!load || *load >= context.scene.n_loads()) return false;
    for (const LoadArrow& arrow : context.load_arrows)
        if (arrow.load == *load) begin_load(context, arrow, false);
    return true;
}

/// The force tool: takes the force that acts there, or makes one.
void Gestures::press_force(GestureContext& context, const PickHit& hit) {
    const std::vector<int> corners =
        surface_vertices(hit, *context.targets[target_].triangles, context.scene.mesh().n_vertices());
    const std::optional<int> present = force_on(context.scene, corners);
    const int load = present ? *present : context.scene.add_load(loadable_patch(context, hit.vertex), ForceLoad{});
    if (load == LiveScene::kNobody) {
        hint_ = "This part is constrained, where a force has no effect. Press where the body is free.";
        action_ = Action::blocked;
        return;
    }
    const Positions& shown = *context.targets[target_].positions;
    const Positions surface = shown.leftCols(context.scene.mesh().n_vertices());
    if (auto arrow = load_arrow(context.scene, load, surface, context.camera.scene().radius)) {
        arrow->inward = false;  // what is dragged is the patch, not the arrow's far end
        begin_load(context, *arrow, !present);
    }
}

void Gestures::begin_load(GestureContext& context, const LoadArrow& arrow, bool is_new) {
    action_ = Action::load;
    load_drag_ = LoadDrag{.arrow = arrow, .is_new = is_new, .handle_before = selected_};
    select_load(arrow.load);
    set_load_baseline(context);
}

void Gestures::set_load_baseline(const GestureContext& context) {
    load_drag_->mode = pull_mode(context.tools);
    load_drag_->cursor = cursor_;
    load_drag_->before = load_value(context.scene, load_drag_->arrow.load);
    const LoadArrow& arrow = load_drag_->arrow;
    const Eigen::VectorXd& before = load_drag_->before;
    const Eigen::Vector3d along = before.size() == 3 ? Eigen::Vector3d((arrow.inward ? -1.0 : 1.0) * before)
                                                     : Eigen::Vector3d(std::abs(before[0]) * arrow.normal);
    load_drag_->end = arrow.place + along / arrow.value_per_length;
}

/// By how much the end of the arrow is to move: in the plane of the screen, or along a line.
Eigen::Vector3d Gestures::load_shift(const GestureContext& context) const {
    const Viewport& viewport = context.targets[target_].viewport;
    const LoadDrag& drag = *load_drag_;
    const bool is_pressure = drag.before.size() == 1;
    const bool along_axis = drag.mode >= PullMode::axis_x && drag.mode <= PullMode::axis_z;
    if (!is_pressure && !along_axis && drag.mode != PullMode::normal)
        return context.camera.drag_in_plane(drag.end, drag.cursor, cursor_, viewport);
    Eigen::Vector3d direction = drag.arrow.normal;
    if (!is_pressure && along_axis)
        direction = Eigen::Vector3d::Unit(static_cast<int>(drag.mode) - static_cast<int>(PullMode::axis_x));
    return direction * dragged_along(context.camera, viewport, drag.end, direction, drag.cursor, cursor_);
}

void Gestures::drag_load(GestureContext& context) {
    if (!gizmo_drag_ && pull_mode(context.tools) != load_drag_->mode) set_load_baseline(context);
    if (!load_drag_->moved && (cursor_ - press_cursor_).norm() < kClickPixels) return;
    load_drag_->moved = true;
    const LoadDrag& drag = *load_drag_;
    if (gizmo_drag_) {
        const double angle = gizmo_drag_->amount = gizmo_amount(context);
        const Eigen::AngleAxisd turn(angle, gizmo_drag_->gizmo.axes.col(gizmo_drag_->part.axis));
        return set_vector(context.scene, drag.arrow.load, turn * Eigen::Vector3d(drag.before));
    }
    const double ratio = drag.arrow.value_per_length;
    const double step = snaps(context.tools) ? round_step(kSnapPart * ratio * context.camera.scene().radius) : 0.0;
    const Eigen::Vector3d change = ratio * load_shift(context);
    if (drag.before.size() == 3) {
        const Eigen::Vector3d value = drag.before + (drag.arrow.inward ? -1.0 : 1.0) * change;
        return set_vector(context.scene, drag.arrow.load, value.unaryExpr([&](double x) { return snapped(x, step); }));
    }
    // Dragged through the surface, a pressure becomes a suction.
    const double sign = drag.before[0] < 0.0 ? -1.0 : 1.0;
    const double size = std::abs(drag.before[0]) + change.dot(drag.arrow.normal);
    context.scene.set_load(drag.arrow.load, PressureLoad{snapped(sign * size, step)});
}

void Gestures::end_load(GestureContext& context) {
    if (load_drag_->is_new && !load_drag_->moved) {
        context.scene.remove_load(load_drag_->arrow.load);  // a click loads nothing
        select_load(std::nullopt);
        select_handle(load_drag_->handle_before);
    }
    context.scene.commit();
    last_dragged_ = DraggedLoad{.load = load_drag_->arrow.load, .inward = load_drag_->arrow.inward};
    load_drag_.reset();
}

void Gestures::remove_dragged_load(GestureContext& context) {
    if (load_drag_->arrow.load == LiveScene::kGravity)
        context.scene.set_gravity(std::nullopt, context.scene.document().density);
    else
        context.scene.remove_load(load_drag_->arrow.load);
    context.scene.commit();
    load_drag_.reset();
    gizmo_drag_.reset();
    select_load(std::nullopt);
    action_ = Action::blocked;  // until the button is let go
}

std::optional<DraggedLoad> Gestures::dragged_load() const {
    if (!load_drag_) return last_dragged_ && last_dragged_->load == selected_load_ ? last_dragged_ : std::nullopt;
    return DraggedLoad{load_drag_->arrow.load, load_drag_->arrow.value_per_length, load_drag_->arrow.inward};
}

/// Adds vertices to the selected pressure, or makes one as soon as they have a triangle; takes them from it.
void Gestures::paint_pressure(GestureContext& context, std::vector<int> vertices) {
    LiveScene& scene = context.scene;
    std::erase_if(vertices, [&](int v) { return v >= scene.mesh().n_vertices(); });
    const bool has_pressure =
        selected_load_ && *selected_load_ >= 0 && *selected_load_ < scene.n_loads() &&
        std::holds_alternative<PressureLoad>(scene.document().loads[static_cast<std::size_t>(*selected_load_)].value);
    std::vector<int> loaded = has_pressure ? scene.loaded_vertices(*selected_load_) : std::vector<int>();
    if (hold_ == Hold::free) {
        const std::size_t n_before = loaded.size();
        std::sort(vertices.begin(), vertices.end());
        std::erase_if(loaded, [&](int v) { return std::binary_search(vertices.begin(), vertices.end(), v); });
        if (has_pressure && loaded.size() < n_before && !scene.set_loaded_vertices(*selected_load_, loaded)) {
            scene.remove_load(*selected_load_);
            select_load(std::nullopt);
        }
        return;
    }
    painted_.insert(painted_.end(), vertices.begin(), vertices.end());
    painted_ = each_once(std::move(painted_));
    const std::size_t n_before = loaded.size();
    loaded.insert(loaded.end(), painted_.begin(), painted_.end());
    loaded = each_once(std::move(loaded));
    if (has_pressure) {
        if (loaded.size() > n_before) scene.set_loaded_vertices(*selected_load_, loaded);
    } else if (const int load = scene.add_load(loaded, PressureLoad{context.tools.pressure});
               load != LiveScene::kNobody) {
        select_load(load);
    }
}

}  // namespace elastolab
