#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/input/navigation.hpp"
#include "app/window/input_event.hpp"

namespace elastolab {

class ViewerState;
class Panels;

/// A key and what it does.
struct Shortcut {
    int key = 0, modifiers = 0;  ///< of GLFW
    std::string keys;            ///< for people: "Ctrl+Z"
    std::string action;
    std::function<void(ViewerState&, Panels&)> run;
};

/// A mouse gesture, for the help.
struct GestureHelp {
    const char* gesture;
    const char* action;
};

const std::vector<Shortcut>& shortcuts();
/// With what turns, moves and zooms the view by this choice of the mouse.
std::vector<GestureHelp> gesture_help(Navigation navigation);

/// Runs what belongs to a key event; false when nothing does.
bool run_shortcut(const InputEvent& event, ViewerState& state, Panels& panels);

}  // namespace elastolab
