// Brush and box: what Gestures does to the vertices that they cover.
#include <utility>

#include "app/input/gestures.hpp"

namespace elastolab {

void Gestures::paint(GestureContext& context) {
    if (target_ >= context.targets.size()) return;
    const PointingTarget& target = context.targets[target_];
    // The mouse jumps from frame to frame: all between belongs to the stroke.
    std::vector<int> vertices =
        vertices_in_brush(context.camera, target.viewport, painted_to_, cursor_, context.tools.brush_pixels,
                          *target.positions, *target.triangles, Reach::visible);
    painted_to_ = cursor_;
    if (context.tools.tool == Tool::pressure) {
        // Whole triangles are pressed. A brush may be smaller than one, which is meant all the same.
        const std::optional<PickHit> hit = hit_in(context, target);
        if (hit && !has_whole_triangle(context.scene.mesh(), vertices)) {
            const std::vector<int> corners =
                surface_vertices(*hit, *target.triangles, context.scene.mesh().n_vertices());
            vertices.insert(vertices.end(), corners.begin(), corners.end());
        }
        paint_pressure(context, std::move(vertices));
    } else {
        fix_or_free(context, std::move(vertices), hold_);
    }
}

/// Fixes or frees these vertices, except those inside the body, in the selected set.
void Gestures::fix_or_free(const GestureContext& context, std::vector<int> vertices, Hold hold) {
    std::erase_if(vertices, [&](int v) { return !context.is_on_surface(v); });
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

}  // namespace elastolab
