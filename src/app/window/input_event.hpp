#pragma once

#include <Eigen/Core>

namespace elastolab {

/// What a person did, as the window reports it. Key codes, buttons and modifiers are those of GLFW.
struct InputEvent {
    enum class Kind { cursor, button, scroll, key, text, focus };
    Kind kind = Kind::cursor;
    Eigen::Vector2d cursor = Eigen::Vector2d::Zero();  ///< where it was then, logical pixels; for scroll: how far
    int code = 0;                                      ///< button, key or character (UTF-32); focus: 1 gained, 0 lost
    bool pressed = false;                              ///< button, key: down (or repeated) or up
    bool repeated = false;
    int modifiers = 0;
    double seconds = 0.0;  ///< Window::seconds()

    bool operator==(const InputEvent&) const = default;
};

}  // namespace elastolab
