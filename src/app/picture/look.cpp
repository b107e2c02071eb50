#include "app/picture/look.hpp"

namespace elastolab {

Look look_of(const ViewerState& state, const SceneViewport& viewport, const Palette& palette, double pixel_ratio) {
    Look look;
    look.kinds = viewport.kinds;
    for (const MethodKind kind : viewport.kinds)
        look.body_revisions.push_back(state.shown.body(kind) != nullptr ? state.shown.body(kind)->revision() : 0);
    const CameraPose& pose = state.camera.pose();
    look.camera_target = pose.target;
    look.camera_turn = pose.orientation.coeffs();
    look.camera_up = state.camera.up_axis();
    look.camera_scene = state.camera.scene().center;
    look.camera_distance = pose.distance;
    look.projection = state.camera.projection_kind();
    look.pixel_ratio = pixel_ratio;
    look.width = viewport.place.width;
    look.height = viewport.place.height;
    look.covered = viewport.place.covered;
    look.display = state.display;
    const ColourScale scale = state.shown.field_scale(state.display);
    look.range = {scale.low, scale.high};
    look.hover = state.gestures.hover();
    look.selected_handle = state.gestures.selected_handle();
    look.selected_fixed = state.gestures.selected_fixed();
    look.pulling = state.gestures.dragging();
    look.selected_load = state.gestures.selected_load();
    look.scene_number = state.scene_number();
    look.scene_revision = state.scene().revision();
    look.palette = &palette;
    return look;
}

}  // namespace elastolab
