#pragma once

#include <Eigen/Core>

namespace elastolab {

/// What a person did, as the window reports it. Key codes, buttons and modifiers are those of GLFW.
struct InputEvent {
    /// fingers: two or more moved on a touch screen, or pinched on a trackpad
    enum class Kind { cursor, button, scroll, key, text, focus, fingers };
    Kind kind = Kind::cursor;
    /// Where it was then, logical pixels; scroll: how far; fingers: their middle.
    Eigen::Vector2d cursor = Eigen::Vector2d::Zero();
    Eigen::Vector2d from = Eigen::Vector2d::Zero();  ///< fingers: their middle before
    double zoom = 1.0;                               ///< fingers: how much farther apart they are than before
    int code = 0;          ///< button, key or character (UTF-32); focus: 1 gained, 0 lost; fingers: how many
    bool pressed = false;  ///< button, key: down (or repeated) or up
    bool repeated = false;
    int modifiers = 0;
    double seconds = 0.0;  ///< Window::seconds()

    bool operator==(const InputEvent&) const = default;
};

}  // namespace elastolab
