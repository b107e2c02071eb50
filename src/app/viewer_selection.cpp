// The selected handle or fixed set of a ViewerState.
#include <algorithm>

#include "app/viewer_state.hpp"

namespace elastolab {

namespace {

constexpr double kAroundSelection = 1.4;  ///< what is framed, of the radius of the selected vertices,
constexpr double kLeastOfBody = 0.12;     ///< and of the body's diagonal at least

}  // namespace

std::optional<ViewerState::Selection> ViewerState::selection() const {
    const Selection latest{gestures.fixed_is_latest(),
                           gestures.fixed_is_latest() ? gestures.selected_fixed() : gestures.selected_handle()};
    const int count = latest.fixed ? scene_->n_fixed_sets() : scene_->n_handles();
    return latest.number >= 0 && latest.number < count ? std::optional(latest) : std::nullopt;
}

std::string ViewerState::selected_name() const {
    const std::optional<Selection> chosen = selection();
    if (!chosen) return "";
    return chosen->fixed ? scene_->fixed_name(chosen->number) : scene_->handle_name(chosen->number);
}

void ViewerState::remove_selection() {
    if (gestures.load_is_latest()) {
        if (gestures.selected_load() == LiveScene::kGravity) {
            finish_gesture();
            scene_->set_gravity(std::nullopt, scene_->document().density);
            scene_->commit();
            gestures.select_load(std::nullopt);
        } else {
            remove_load(gestures.selected_load().value_or(-1));
        }
        return;
    }
    const std::optional<Selection> chosen = selection();
    if (!chosen) return;
    if (chosen->fixed)
        remove_fixed_set(chosen->number);
    else
        remove_handle(chosen->number);
}

void ViewerState::frame_selection() {
    const std::optional<Selection> chosen = selection();
    const ShownBody* body = shown.body(method);
    if (!chosen || body == nullptr) return;
    const std::span<const int> vertices =
        chosen->fixed ? scene_->fixed_vertices(chosen->number) : scene_->vertices(chosen->number);
    const Positions at = body->positions()(Eigen::all, std::vector<int>(vertices.begin(), vertices.end()));
    const Eigen::Vector3d middle = at.rowwise().mean();
    const double extent = (at.colwise() - middle).colwise().norm().maxCoeff();
    const double diagonal = (scene_->report().max_corner - scene_->report().min_corner).norm();
    camera.frame({middle, std::max(kAroundSelection * extent, kLeastOfBody * diagonal)},
                 shown.viewports.empty() ? 1.3 : shown.viewports.front().place.free_aspect());
}

void ViewerState::select_next_handle() {
    finish_gesture();
    if (const int n = scene_->n_handles(); n > 0) gestures.select_handle((gestures.selected_handle() + 1) % n);
}

void ViewerState::select_next_fixed_set() {
    finish_gesture();
    const int n = scene_->n_fixed_sets(), next = gestures.selected_fixed() + 1;
    if (n > 0) gestures.select_fixed(next < n ? next : 0);  // a set that was only begun is behind the last
}

void ViewerState::begin_fixed_set() {
    finish_gesture();
    gestures.select_fixed(scene_->n_fixed_sets());
    if (tools.tool != Tool::box) tools.tool = Tool::brush;
}

}  // namespace elastolab
