#pragma once

#include <optional>

#include "app/window/six_axis_mouse.hpp"

namespace elastolab {

class ViewerState;

/// Moves and turns the selected handle by a six-axis mouse, as it is seen on the screen. What is done without a pause
/// is one step for undo.
class SixAxisControl {
public:
    /// One frame. Returns whether the scene changed. Does nothing where no handle is selected or the mouse drags.
    bool apply(const std::optional<SixAxisMotion>& motion, double now, ViewerState& state);
    /// Ends the step at once: a key or a button is pressed.
    void end_step(ViewerState& state);
    /// Seconds until a pause ends the step; negative: nothing is under way.
    double due_in(double now) const;

private:
    double moved_at_ = -1.0;
};

}  // namespace elastolab
