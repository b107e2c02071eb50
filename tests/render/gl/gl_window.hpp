#pragma once

struct GLFWwindow;

namespace elastolab::test {

/// A hidden window with a context of OpenGL 3.3 core, current while it lives.
class GlWindow {
public:
    GlWindow();
    ~GlWindow();
    GlWindow(const GlWindow&) = delete;
    GlWindow& operator=(const GlWindow&) = delete;

private:
    GLFWwindow* window_ = nullptr;
};

}  // namespace elastolab::test
