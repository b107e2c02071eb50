#include "app/shortcuts.hpp"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>

#include "app/names.hpp"
#include "app/panels/panels.hpp"
#include "app/selection.hpp"
#include "app/viewer_state.hpp"
#include "methods/registry.hpp"

namespace elastolab {

namespace {

constexpr int kModifiers = GLFW_MOD_CONTROL | GLFW_MOD_SHIFT | GLFW_MOD_ALT;
constexpr double kRadiusStep = 1.2;

/// Below half an edge a patch is a single vertex.
void change_radius(ViewerState& state, double factor) {
    const double edge = state.scene().report().mean_edge;
    double& radius = state.tools.patch_radius;
    radius *= factor;
    if (factor > 1.0) radius = std::max(radius, edge);
    if (radius < 0.5 * edge) radius = 0.0;
}

/// Keys of the number block that share a line of the help with another.
struct ViewKey {
    int key, modifiers;
    ViewDirection from;
};
constexpr std::array<ViewKey, 5> kViewKeys = {{{GLFW_KEY_KP_1, GLFW_MOD_CONTROL, ViewDirection::back},
                                               {GLFW_KEY_KP_3, 0, ViewDirection::right},
                                               {GLFW_KEY_KP_3, GLFW_MOD_CONTROL, ViewDirection::left},
                                               {GLFW_KEY_KP_7, 0, ViewDirection::top},
                                               {GLFW_KEY_KP_7, GLFW_MOD_CONTROL, ViewDirection::bottom}}};

/// What keys of the number block do to the view; false for others.
bool run_view_key(int key, int modifiers, Camera& camera) {
    if (key == GLFW_KEY_KP_5 && modifiers == 0) {
        toggle_projection(camera);
        return true;
    }
    for (const ViewKey& view : kViewKeys)
        if (view.key == key && view.modifiers == modifiers) {
            camera.set_view(view.from);
            return true;
        }
    return false;
}

std::vector<Shortcut> make_shortcuts() {
    std::vector<Shortcut> all;
    int number = 0;
    for (const MethodKind kind : all_methods()) {
        ++number;
        all.push_back({GLFW_KEY_0 + number, 0, std::to_string(number), title(kind),
                       [kind](ViewerState& s, Panels&) { s.select_method(kind); }});
    }
    const std::vector<Shortcut> more = {
        {GLFW_KEY_V, 0, "V", "pull tool", [](ViewerState& s, Panels&) { s.tools.tool = Tool::pull; }},
        {GLFW_KEY_B, 0, "B", "brush: fix vertices", [](ViewerState& s, Panels&) { s.tools.tool = Tool::brush; }},
        {GLFW_KEY_N, 0, "N", "box: fix vertices", [](ViewerState& s, Panels&) { s.tools.tool = Tool::box; }},
        {GLFW_KEY_I, 0, "I", "probe: values at a vertex", [](ViewerState& s, Panels&) { s.tools.tool = Tool::probe; }},
        {GLFW_KEY_L, 0, "L", "force tool", [](ViewerState& s, Panels&) { s.tools.tool = Tool::force; }},
        {GLFW_KEY_K, 0, "K", "brush: pressure", [](ViewerState& s, Panels&) { s.tools.tool = Tool::pressure; }},
        {GLFW_KEY_LEFT_BRACKET, 0, "[", "smaller patch",
         [](ViewerState& s, Panels&) { change_radius(s, 1.0 / kRadiusStep); }},
        {GLFW_KEY_RIGHT_BRACKET, 0, "]", "larger patch",
         [](ViewerState& s, Panels&) { change_radius(s, kRadiusStep); }},
        {GLFW_KEY_H, 0, "H", "select the next handle", [](ViewerState& s, Panels&) { select_next_handle(s); }},
        {GLFW_KEY_J, 0, "J", "select the next fixed set", [](ViewerState& s, Panels&) { select_next_fixed_set(s); }},
        {GLFW_KEY_N, GLFW_MOD_SHIFT, "Shift+N", "begin a new fixed set",
         [](ViewerState& s, Panels&) { begin_fixed_set(s); }},
        {GLFW_KEY_F2, 0, "F2", "rename the selected handle or fixed set",
         [](ViewerState& s, Panels& p) { p.selection().rename(s); }},
        {GLFW_KEY_DELETE, 0, "Del", "remove the selected handle, fixed set or load",
         [](ViewerState& s, Panels&) { remove_selection(s); }},
        {GLFW_KEY_DELETE, GLFW_MOD_SHIFT, "Shift+Del", "remove all handles",
         [](ViewerState& s, Panels&) { s.clear_handles(); }},
        {GLFW_KEY_Z, GLFW_MOD_CONTROL, "Ctrl+Z", "undo", [](ViewerState& s, Panels&) { s.undo(); }},
        {GLFW_KEY_Y, GLFW_MOD_CONTROL, "Ctrl+Y or Ctrl+Shift+Z", "redo", [](ViewerState& s, Panels&) { s.redo(); }},
        {GLFW_KEY_F, 0, "F", "frame the body", [](ViewerState& s, Panels&) { s.frame_body(); }},
        {GLFW_KEY_F, GLFW_MOD_SHIFT, "Shift+F", "frame the selected handle or fixed set",
         [](ViewerState& s, Panels&) { frame_selection(s); }},
        {GLFW_KEY_O, 0, "O or Num 5", "orthographic or perspective",
         [](ViewerState& s, Panels&) { toggle_projection(s.camera); }},
        {GLFW_KEY_KP_1, 0, "Num 1, 3, 7", "look from the front, right, top; with Ctrl from the other side",
         [](ViewerState& s, Panels&) { s.camera.set_view(ViewDirection::front); }},
        {GLFW_KEY_C, 0, "C", "compare side by side",
         [](ViewerState& s, Panels&) { s.toggle_comparison(CompareMode::side_by_side); }},
        {GLFW_KEY_G, 0, "G", "compare as ghosts",
         [](ViewerState& s, Panels&) { s.toggle_comparison(CompareMode::ghosts); }},
        {GLFW_KEY_W, 0, "W", "wireframe on or off",
         [](ViewerState& s, Panels&) { s.display.wireframe = !s.display.wireframe; }},
        {GLFW_KEY_P, 0, "P", "show or fold the panel",
         [](ViewerState& s, Panels&) { s.display.panel = !s.display.panel; }},
        {GLFW_KEY_T, 0, "T", "light or dark theme", [](ViewerState& s, Panels&) { s.display.dark = !s.display.dark; }},
        {GLFW_KEY_O, GLFW_MOD_CONTROL, "Ctrl+O", "open a mesh or scene",
         [](ViewerState& s, Panels& p) { p.files().ask_open(s); }},
        {GLFW_KEY_S, GLFW_MOD_CONTROL, "Ctrl+S", "save the scene",
         [](ViewerState& s, Panels& p) { p.files().save(s); }},
        {GLFW_KEY_S, GLFW_MOD_CONTROL | GLFW_MOD_SHIFT, "Ctrl+Shift+S", "save the scene under another name",
         [](ViewerState& s, Panels& p) { p.files().save_as(s); }},
        {GLFW_KEY_F1, 0, "F1 or ?", "show or hide this help",
         [](ViewerState& s, Panels&) { s.show_help = !s.show_help; }},
        {GLFW_KEY_ESCAPE, 0, "Esc", "close help and messages",
         [](ViewerState& s, Panels&) {
             s.show_help = false;
             while (!s.messages.all().empty()) s.messages.dismiss(0);
         }},
        {GLFW_KEY_Q, GLFW_MOD_CONTROL, "Ctrl+Q", "quit", [](ViewerState& s, Panels&) { s.quit(); }},
    };
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

}  // namespace

const std::vector<Shortcut>& shortcuts() {
    static const std::vector<Shortcut> all = make_shortcuts();
    return all;
}

std::vector<GestureHelp> gesture_help(Navigation navigation) {
    static constexpr std::array<GestureHelp, 6> of_pulls = {
        {{"drag on the body", "pull the patch under the cursor, in the plane of the screen"},
         {"... with Shift", "along the surface normal"},
         {"... with X, Y or Z", "along an axis"},
         {"... with Ctrl or R", "turn the patch"},
         {"... with Alt or S", "scale the patch: up larger, down smaller"},
         {"arrow or ring", "move or turn the selected handle, or the plane of the cut; with Ctrl in steps"}}};
    static constexpr std::array<GestureHelp, 10> others = {
        {{"letter of the axes", "look along that axis; again: from the other side"},
         {"double click", "frame the body"},
         {"brush: drag, click", "fix vertices; with Shift free them"},
         {"probe: click", "keep or forget the values at a vertex"},
         {"box: drag", "fix the vertices in the box; with Shift free them"},
         {"force: drag",
          "a force on the patch under the cursor; its arrow grows with the mouse; Shift, X, Y, Z as for a pull"},
         {"pressure: drag", "a pressure where it is painted; with Shift take the paint off"},
         {"end of an arrow", "drag it: another size or direction of the load; Shift, X, Y, Z as for a pull"},
         {"touch screen", "one finger is the left button; two move and zoom the view, three turn it"},
         {"drop a file", "open it"}}};
    const ViewHelp view = view_help(navigation);
    std::vector<GestureHelp> result(of_pulls.begin(), of_pulls.end());
    result.insert(result.end(), {{"to turn the view", view.turn}, {"to move it", view.move}, {"to zoom", view.zoom}});
    result.insert(result.end(), others.begin(), others.end());
    return result;
}

bool run_shortcut(const InputEvent& event, ViewerState& state, Panels& panels) {
    if (event.kind != InputEvent::Kind::key || !event.pressed) return false;
    const int modifiers = event.modifiers & kModifiers;
    for (const Shortcut& shortcut : shortcuts())
        if (shortcut.key == event.code && shortcut.modifiers == modifiers) {
            shortcut.run(state, panels);
            return true;
        }
    if (event.code == GLFW_KEY_Z && modifiers == (GLFW_MOD_CONTROL | GLFW_MOD_SHIFT)) {
        state.redo();
        return true;
    }
    return run_view_key(event.code, modifiers, state.camera);
}

}  // namespace elastolab
