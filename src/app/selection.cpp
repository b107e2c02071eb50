#include "app/selection.hpp"

#include <algorithm>

#include "app/viewer_state.hpp"

namespace elastolab {

namespace {

constexpr double kAroundSelection = 1.4;  ///< what is framed, of the radius of the selected vertices,
constexpr double kLeastOfBody = 0.12;     ///< and of the body's diagonal at least

}  // namespace

std::optional<Selection> selection(const ViewerState& state) {
    const Gestures& gestures = state.gestures;
    const Selection latest{gestures.fixed_is_latest(),
                           gestures.fixed_is_latest() ? gestures.selected_fixed() : gestures.selected_handle()};
    const int count = latest.fixed ? state.scene().n_fixed_sets() : state.scene().n_handles();
    return latest.number >= 0 && latest.number < count ? std::optional(latest) : std::nullopt;
}

std::string selected_name(const ViewerState& state) {
    const std::optional<Selection> chosen = selection(state);
    if (!chosen) return "";
    return chosen->fixed ? state.scene().fixed_name(chosen->number) : state.scene().handle_name(chosen->number);
}

void remove_selection(ViewerState& state) {
    if (state.gestures.load_is_latest()) {
        if (state.gestures.selected_load() == LiveScene::kGravity) {
            state.finish_gesture();
            state.scene().set_gravity(std::nullopt, state.scene().document().density);
            state.scene().commit();
            state.gestures.select_load(std::nullopt);
        } else {
            state.remove_load(state.gestures.selected_load().value_or(-1));
        }
        return;
    }
    const std::optional<Selection> chosen = selection(state);
    if (!chosen) return;
    if (chosen->fixed)
        state.remove_fixed_set(chosen->number);
    else
        state.remove_handle(chosen->number);
}

void frame_selection(ViewerState& state) {
    const std::optional<Selection> chosen = selection(state);
    const ShownBody* body = state.shown.body(state.method);
    if (!chosen || body == nullptr) return;
    const std::span<const int> vertices =
        chosen->fixed ? state.scene().fixed_vertices(chosen->number) : state.scene().vertices(chosen->number);
    const Positions at = body->positions()(Eigen::all, std::vector<int>(vertices.begin(), vertices.end()));
    const Eigen::Vector3d middle = at.rowwise().mean();
    const double extent = (at.colwise() - middle).colwise().norm().maxCoeff();
    const double diagonal = (state.scene().report().max_corner - state.scene().report().min_corner).norm();
    state.camera.frame({middle, std::max(kAroundSelection * extent, kLeastOfBody * diagonal)},
                       state.shown.viewports.empty() ? 1.3 : state.shown.viewports.front().place.free_aspect());
}

void select_next_handle(ViewerState& state) {
    state.finish_gesture();
    if (const int n = state.scene().n_handles(); n > 0)
        state.gestures.select_handle((state.gestures.last_handle() + 1) % n);
}

void select_next_fixed_set(ViewerState& state) {
    state.finish_gesture();
    const int n = state.scene().n_fixed_sets(), next = state.gestures.selected_fixed() + 1;
    if (n > 0) state.gestures.select_fixed(next < n ? next : 0);  // a set that was only begun is behind the last
}

void begin_fixed_set(ViewerState& state) {
    state.finish_gesture();
    state.gestures.select_fixed(state.scene().n_fixed_sets());
    if (state.tools.tool != Tool::box) state.tools.tool = Tool::brush;
}

}  // namespace elastolab
