#include "render/gl/gl_window.hpp"

#include <GLFW/glfw3.h>

#include <stdexcept>

namespace elastolab::test {

GlWindow::GlWindow() {
    if (glfwInit() != GLFW_TRUE) throw std::runtime_error("no display");
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
    window_ = glfwCreateWindow(64, 64, "test", nullptr, nullptr);
    if (window_ == nullptr) throw std::runtime_error("no OpenGL 3.3 core");
    glfwMakeContextCurrent(window_);
}

GlWindow::~GlWindow() {
    glfwDestroyWindow(window_);
    glfwTerminate();
}

}  // namespace elastolab::test
