#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "app/window/input_event.hpp"

struct GLFWwindow;

namespace elastolab {

/// Fingers on a touch screen and pinches on a trackpad, which GLFW does not report: by XInput 2, where the program was
/// built with it and the window is on an X server that knows it (2.2 for touch screens, 2.4 for pinches); else there
/// are none. The window then gets no emulated mouse for them: what one finger means is told by Fingers.
class TouchScreen {
public:
    /// `wake` is called on a thread of its own when take() will find something. The window outlives this.
    TouchScreen(GLFWwindow* window, std::function<void()> wake);
    ~TouchScreen();
    TouchScreen(const TouchScreen&) = delete;
    TouchScreen& operator=(const TouchScreen&) = delete;

    /// Whether the program was built with XInput 2.
    static bool supported();
    /// What came since the last call, in order; times and modifiers are not set.
    std::vector<InputEvent> take();

private:
    class Connection;
    std::unique_ptr<Connection> connection_;
};

}  // namespace elastolab
