#include "app/window/window.hpp"

#include <epoxy/gl.h>
// After epoxy, which must come before any other OpenGL header.
#include <GLFW/glfw3.h>

#include <array>
#include <mutex>
#include <optional>
#include <utility>

#include "app/window/touch_screen.hpp"
#include "base/error.hpp"

namespace elastolab {

namespace {

std::string last_glfw_error() {
    const char* description = nullptr;
    glfwGetError(&description);
    return description != nullptr ? description : "no reason given";
}

/// Whether a window is there that can be woken. Workers may begin before it and end after it.
std::mutex wake_mutex;
bool can_wake = false;

void let_wake(bool value) {
    const std::lock_guard lock(wake_mutex);
    can_wake = value;
}

constexpr std::array kCursorShapes = {GLFW_ARROW_CURSOR,   GLFW_IBEAM_CURSOR,   GLFW_HAND_CURSOR,
                                      GLFW_HRESIZE_CURSOR, GLFW_VRESIZE_CURSOR, GLFW_CROSSHAIR_CURSOR};

}  // namespace

struct Window::State {
    std::vector<InputEvent> events;
    std::vector<std::filesystem::path> dropped;
    bool damaged = true;
    int modifiers = 0;
    Eigen::Vector2d cursor = Eigen::Vector2d::Zero();
    std::array<GLFWcursor*, kCursorShapes.size()> cursors{};
    CursorShape shape = CursorShape::arrow;
    std::optional<TouchScreen> touch_screen;  ///< none where nobody sees the window

    void add(InputEvent event) {
        event.seconds = glfwGetTime();
        event.modifiers = modifiers;
        events.push_back(event);
    }
};

/// What GLFW calls; each adds an event to the state of its window.
struct Window::Callbacks {
    static State& state(GLFWwindow* window) { return *static_cast<State*>(glfwGetWindowUserPointer(window)); }

    static void cursor(GLFWwindow* window, double x, double y) {
        state(window).cursor = {x, y};
        state(window).add({.kind = InputEvent::Kind::cursor, .cursor = {x, y}});
    }
    static void button(GLFWwindow* window, int button, int action, int modifiers) {
        State& s = state(window);
        s.modifiers = modifiers;
        s.add({.kind = InputEvent::Kind::button, .cursor = s.cursor, .code = button, .pressed = action == GLFW_PRESS});
    }
    static void scroll(GLFWwindow* window, double dx, double dy) {
        state(window).add({.kind = InputEvent::Kind::scroll, .cursor = {dx, dy}});
    }
    static void key(GLFWwindow* window, int key, int /*scancode*/, int action, int modifiers) {
        State& s = state(window);
        s.modifiers = with_own_bit(modifiers, key, action != GLFW_RELEASE);
        s.add({.kind = InputEvent::Kind::key,
               .cursor = s.cursor,
               .code = key,
               .pressed = action != GLFW_RELEASE,
               .repeated = action == GLFW_REPEAT});
    }
    static void text(GLFWwindow* window, unsigned character) {
        state(window).add({.kind = InputEvent::Kind::text, .code = static_cast<int>(character)});
    }
    static void focus(GLFWwindow* window, int focused) {
        state(window).add({.kind = InputEvent::Kind::focus, .code = focused});
    }
    static void drop(GLFWwindow* window, int count, const char** paths) {
        for (int i = 0; i < count; ++i) state(window).dropped.emplace_back(paths[i]);
    }
    static void refresh(GLFWwindow* window) { state(window).damaged = true; }
    static void resized(GLFWwindow* window, int, int) { state(window).damaged = true; }

    /// On X11 the modifiers of a key event are those from before it: a modifier key's own bit is late.
    static int with_own_bit(int modifiers, int key, bool down) {
        int bit = 0;
        if (key == GLFW_KEY_LEFT_SHIFT || key == GLFW_KEY_RIGHT_SHIFT) bit = GLFW_MOD_SHIFT;
        if (key == GLFW_KEY_LEFT_CONTROL || key == GLFW_KEY_RIGHT_CONTROL) bit = GLFW_MOD_CONTROL;
        if (key == GLFW_KEY_LEFT_ALT || key == GLFW_KEY_RIGHT_ALT) bit = GLFW_MOD_ALT;
        return down ? modifiers | bit : modifiers & ~bit;
    }
};

Window::Window(const Options& options) : state_(std::make_unique<State>()), title_(options.title) {
    if (glfwInit() != GLFW_TRUE)
        throw Error("window: there is no display (" + last_glfw_error() +
                    "). Start it on a desktop, or under xvfb-run; elastolab solve needs none.");
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_VISIBLE, options.visible ? GLFW_TRUE : GLFW_FALSE);
    handle_ = glfwCreateWindow(options.width, options.height, options.title.c_str(), nullptr, nullptr);
    if (handle_ == nullptr) {
        const std::string reason = last_glfw_error();
        glfwTerminate();
        throw Error("window: no OpenGL 3.3 (" + reason +
                    "). Update the graphics driver, or set LIBGL_ALWAYS_SOFTWARE=1.");
    }
    glfwSetWindowUserPointer(handle_, state_.get());
    glfwMakeContextCurrent(handle_);
    glfwSetCursorPosCallback(handle_, &Callbacks::cursor);
    glfwSetMouseButtonCallback(handle_, &Callbacks::button);
    glfwSetScrollCallback(handle_, &Callbacks::scroll);
    glfwSetKeyCallback(handle_, &Callbacks::key);
    glfwSetCharCallback(handle_, &Callbacks::text);
    glfwSetWindowFocusCallback(handle_, &Callbacks::focus);
    glfwSetDropCallback(handle_, &Callbacks::drop);
    glfwSetWindowRefreshCallback(handle_, &Callbacks::refresh);
    glfwSetFramebufferSizeCallback(handle_, &Callbacks::resized);
    glfwSwapInterval(options.visible ? 1 : 0);
    let_wake(true);
    if (options.visible) state_->touch_screen.emplace(handle_, [] { wake(); });
}

Window::~Window() {
    let_wake(false);
    state_->touch_screen.reset();
    for (GLFWcursor* cursor : state_->cursors)
        if (cursor != nullptr) glfwDestroyCursor(cursor);
    glfwDestroyWindow(handle_);
    glfwTerminate();
}

void Window::wait(double timeout) {
    if (timeout < 0.0)
        glfwWaitEvents();
    else if (timeout == 0.0)
        glfwPollEvents();
    else
        glfwWaitEventsTimeout(timeout);
}

void Window::wake() {
    const std::lock_guard lock(wake_mutex);
    if (can_wake) glfwPostEmptyEvent();
}

std::vector<InputEvent> Window::take_events() {
    if (state_->touch_screen)
        for (const InputEvent& event : state_->touch_screen->take()) {
            state_->cursor = event.cursor;
            state_->add(event);
        }
    return std::exchange(state_->events, {});
}

std::vector<std::filesystem::path> Window::take_dropped_files() { return std::exchange(state_->dropped, {}); }
bool Window::take_damage() { return std::exchange(state_->damaged, false); }

bool Window::close_requested() const { return glfwWindowShouldClose(handle_) == GLFW_TRUE; }
void Window::request_close() { glfwSetWindowShouldClose(handle_, GLFW_TRUE); }
void Window::stay_open() { glfwSetWindowShouldClose(handle_, GLFW_FALSE); }

Eigen::Vector2i Window::size() const {
    Eigen::Vector2i size;
    glfwGetWindowSize(handle_, &size.x(), &size.y());
    return size;
}

Eigen::Vector2i Window::framebuffer_size() const {
    Eigen::Vector2i size;
    glfwGetFramebufferSize(handle_, &size.x(), &size.y());
    return size;
}

float Window::content_scale() const {
    float x = 1.0f, y = 1.0f;
    glfwGetWindowContentScale(handle_, &x, &y);
    return x;
}

void Window::set_title(const std::string& title) {
    if (title == title_) return;
    title_ = title;
    glfwSetWindowTitle(handle_, title_.c_str());
}

void Window::swap_buffers() { glfwSwapBuffers(handle_); }
void Window::disable_vsync() { glfwSwapInterval(0); }
void Window::hide() { glfwHideWindow(handle_); }
void Window::set_size(const Eigen::Vector2i& size) { glfwSetWindowSize(handle_, size.x(), size.y()); }

std::string Window::clipboard() const {
    const char* text = glfwGetClipboardString(handle_);
    return text != nullptr ? text : "";
}
void Window::set_clipboard(const std::string& text) { glfwSetClipboardString(handle_, text.c_str()); }

void Window::set_cursor(CursorShape shape) {
    if (std::exchange(state_->shape, shape) == shape) return;
    const auto index = static_cast<std::size_t>(shape);
    if (state_->cursors[index] == nullptr) state_->cursors[index] = glfwCreateStandardCursor(kCursorShapes[index]);
    glfwSetCursor(handle_, state_->cursors[index]);
}

double Window::seconds() { return glfwGetTime(); }

}  // namespace elastolab
