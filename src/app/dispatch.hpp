#pragma once

#include <vector>

#include "app/window/input_event.hpp"

namespace elastolab {

class Gui;
class Panels;
class ViewerState;

/// Hands each event to what it is for: keys to the shortcuts, the rest to the gestures unless the panels have taken it.
/// Whether the camera is still turning by itself at `now` [s, Window::seconds()]: another frame is to be drawn then.
bool dispatch(const std::vector<InputEvent>& events, double now, const Gui& gui, ViewerState& state, Panels& panels);

}  // namespace elastolab
