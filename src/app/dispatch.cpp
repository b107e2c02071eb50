#include "app/dispatch.hpp"

#include <GLFW/glfw3.h>

#include <utility>

#include "app/panels/gui.hpp"
#include "app/panels/panels.hpp"
#include "app/shortcuts.hpp"
#include "app/viewer_state.hpp"

namespace elastolab {

namespace {

/// The mouse is over a panel, and neither pulls nor turns anything. Keys that were held over the scene may be let go
/// anywhere.
bool is_for_panels(const InputEvent& event, const Gui& gui, const Gestures& gestures) {
    const bool lets_go =
        event.kind == InputEvent::Kind::focus || (event.kind == InputEvent::Kind::key && !event.pressed);
    return gui.wants_mouse() && gestures.action() == Gestures::Action::none && !lets_go;
}

/// Keys belong to a drag; of a stroke Esc alone, which takes it back.
bool is_for_gesture(const InputEvent& key, const Gestures& gestures) {
    return gestures.dragging() || (gestures.edits() && key.code == GLFW_KEY_ESCAPE);
}

}  // namespace

bool dispatch(const std::vector<InputEvent>& events, double now, const Gui& gui, ViewerState& state, Panels& panels) {
    GestureContext context = state.gesture_context();
    for (const InputEvent& event : events) {
        const bool keys_are_free = !gui.wants_keys();
        if (event.kind == InputEvent::Kind::text && event.code == '?' && keys_are_free)
            state.show_help = !state.show_help;
        if (event.kind == InputEvent::Kind::key && keys_are_free && !is_for_gesture(event, state.gestures) &&
            !state.blank() && run_shortcut(event, state, panels)) {
            GestureContext changed = state.gesture_context();
            context.targets = std::move(changed.targets);
            context.gizmos = std::move(changed.gizmos);
            context.load_arrows = std::move(changed.load_arrows);
            continue;
        }
        if (is_for_panels(event, gui, state.gestures))
            state.gestures.clear_hover();
        else
            state.gestures.handle(event, context);
    }
    if (state.gestures.take_frame_request()) state.frame_body();
    if (const auto vertex = state.gestures.take_probed()) state.probes.toggle(*vertex);
    return state.gestures.animate(now, context);
}

}  // namespace elastolab
