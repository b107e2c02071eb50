#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/window/input_event.hpp"

struct GLFWwindow;

namespace elastolab {

/// A window with an OpenGL 3.3 core context, current on the thread that makes it. One at a time.
class Window {
public:
    struct Options {
        std::string title = "Elastolab";  ///< at first
        int width = 1280, height = 800;   ///< logical pixels
        bool visible = true;
    };

    /// Throws Error when there is no display or no OpenGL 3.3.
    explicit Window(const Options& options);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// Sleeps until something happens, at most `timeout` seconds: forever when negative, not at all when zero.
    void wait(double timeout);
    /// Ends a wait(); for any thread. Without a window it does nothing.
    static void wake();

    /// What happened since the last call, in order.
    std::vector<InputEvent> take_events();
    std::vector<std::filesystem::path> take_dropped_files();
    /// Whether the window was exposed or resized since the last call, so that it must be drawn.
    bool take_damage();

    bool close_requested() const;
    void request_close();
    void stay_open();                          ///< takes a request back
    Eigen::Vector2i size() const;              ///< logical pixels; zero when minimised
    Eigen::Vector2i framebuffer_size() const;  ///< physical pixels
    float content_scale() const;               ///< suggested size of text: 1 on an ordinary screen
    /// Does nothing where that is its title already.
    void set_title(const std::string& title);
    void swap_buffers();
    /// From now on swap_buffers() does not wait for the screen's refresh, as it does in a visible window otherwise.
    void disable_vsync();
    void hide();
    /// In logical pixels; it takes effect some frames later, or not at all where a window manager does not let it.
    void set_size(const Eigen::Vector2i& size);

    std::string clipboard() const;
    void set_clipboard(const std::string& text);
    enum class CursorShape { arrow, text, hand, resize_horizontal, resize_vertical, cross };
    void set_cursor(CursorShape shape);

    static double seconds();  ///< since GLFW was initialised

private:
    struct Callbacks;
    struct State;
    std::unique_ptr<State> state_;
    GLFWwindow* handle_ = nullptr;
    std::string title_;
};

}  // namespace elastolab
