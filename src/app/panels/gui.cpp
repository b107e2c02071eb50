#include "app/panels/gui.hpp"

#include <backends/imgui_impl_opengl3.h>
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <utility>

namespace elastolab {

namespace {

constexpr float kNotchPixels = 75.0f;  ///< that Dear ImGui scrolls by for a notch of the wheel: five lines

/// Keys by which ImGui edits text and moves about.
void map_keys(ImGuiIO& io) {
    constexpr std::array<std::pair<int, int>, 22> keys = {{{ImGuiKey_Tab, GLFW_KEY_TAB},
                                                           {ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
                                                           {ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
                                                           {ImGuiKey_UpArrow, GLFW_KEY_UP},
                                                           {ImGuiKey_DownArrow, GLFW_KEY_DOWN},
                                                           {ImGuiKey_PageUp, GLFW_KEY_PAGE_UP},
                                                           {ImGuiKey_PageDown, GLFW_KEY_PAGE_DOWN},
                                                           {ImGuiKey_Home, GLFW_KEY_HOME},
                                                           {ImGuiKey_End, GLFW_KEY_END},
                                                           {ImGuiKey_Insert, GLFW_KEY_INSERT},
                                                           {ImGuiKey_Delete, GLFW_KEY_DELETE},
                                                           {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
                                                           {ImGuiKey_Space, GLFW_KEY_SPACE},
                                                           {ImGuiKey_Enter, GLFW_KEY_ENTER},
                                                           {ImGuiKey_Escape, GLFW_KEY_ESCAPE},
                                                           {ImGuiKey_KeyPadEnter, GLFW_KEY_KP_ENTER},
                                                           {ImGuiKey_A, GLFW_KEY_A},
                                                           {ImGuiKey_C, GLFW_KEY_C},
                                                           {ImGuiKey_V, GLFW_KEY_V},
                                                           {ImGuiKey_X, GLFW_KEY_X},
                                                           {ImGuiKey_Y, GLFW_KEY_Y},
                                                           {ImGuiKey_Z, GLFW_KEY_Z}}};
    for (const auto& [imgui, glfw] : keys) io.KeyMap[imgui] = glfw;
}

void set_clipboard(ImGuiIO& io, Window& window) {
    io.ClipboardUserData = &window;
    io.SetClipboardTextFn = [](void* user, const char* text) { static_cast<Window*>(user)->set_clipboard(text); };
    io.GetClipboardTextFn = [](void* user) {
        static std::string text;  // ImGui wants it to stay until the next call
        text = static_cast<Window*>(user)->clipboard();
        return text.c_str();
    };
}

}  // namespace

Gui::Gui(Window& window) : window_(window), fonts_(window) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.BackendFlags |= ImGuiBackendFlags_HasMouseCursors;
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    io.MousePos = {-1e6f, -1e6f};
    map_keys(io);
    set_clipboard(io, window_);
    ImGui_ImplOpenGL3_Init("#version 330 core");
}

Gui::~Gui() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext();
}

std::size_t Gui::n_for_one_frame(std::span<const InputEvent> events) {
    std::vector<std::pair<InputEvent::Kind, int>> changed;
    for (std::size_t i = 0; i < events.size(); ++i) {
        const InputEvent& event = events[i];
        const auto is_button = [](const auto& of) { return of.first == InputEvent::Kind::button; };
        if (event.kind == InputEvent::Kind::cursor && std::any_of(changed.begin(), changed.end(), is_button))
            return i;  // the button counts where the cursor was
        if (event.kind == InputEvent::Kind::cursor && i > 0 && events[i - 1].kind == InputEvent::Kind::fingers)
            return i;  // so do fingers
        if (i > 0 && events[i - 1].kind == InputEvent::Kind::key && events[i - 1].code == GLFW_KEY_F2)
            return i;  // opens a field for what follows
        if (event.kind != InputEvent::Kind::button && event.kind != InputEvent::Kind::key) continue;
        const std::pair key(event.kind, event.code);
        if (std::find(changed.begin(), changed.end(), key) != changed.end()) return i;
        changed.push_back(key);
    }
    return events.size();
}

void Gui::feed(const InputEvent& event) {
    ImGuiIO& io = ImGui::GetIO();
    const auto code = static_cast<std::size_t>(event.code);
    switch (event.kind) {
        case InputEvent::Kind::cursor:
            io.MousePos = {static_cast<float>(event.cursor.x()), static_cast<float>(event.cursor.y())};
            break;
        case InputEvent::Kind::button:
            if (code < std::size(io.MouseDown)) io.MouseDown[code] = event.pressed;
            break;
        case InputEvent::Kind::scroll:
            io.MouseWheelH += static_cast<float>(event.cursor.x());
            io.MouseWheel += static_cast<float>(event.cursor.y());
            break;
        case InputEvent::Kind::fingers:  // the cursor stays where they came down: what is there keeps them
            io.MouseWheel += static_cast<float>(event.cursor.y() - event.from.y()) / (kNotchPixels * fonts_.scale());
            break;
        case InputEvent::Kind::key:
            if (code < std::size(io.KeysDown)) io.KeysDown[code] = event.pressed;
            // Dear ImGui chooses an entry of a menu by Space alone.
            if (event.code == GLFW_KEY_ENTER && (!event.pressed || menu_is_open()))
                io.KeysDown[GLFW_KEY_SPACE] = event.pressed;
            break;
        case InputEvent::Kind::text:
            io.AddInputCharacter(static_cast<unsigned>(event.code));
            fonts_.want_character(static_cast<char32_t>(event.code));
            break;
        case InputEvent::Kind::focus:
            io.AddFocusEvent(event.code != 0);
            break;
    }
    io.KeyShift = (event.modifiers & GLFW_MOD_SHIFT) != 0;
    io.KeyCtrl = (event.modifiers & GLFW_MOD_CONTROL) != 0;
    // Alt is for scaling what is pulled; F10 is what goes to the menu.
    if (event.kind == InputEvent::Kind::key && event.code == GLFW_KEY_F10) io.KeyAlt = event.pressed;
    io.KeySuper = (event.modifiers & GLFW_MOD_SUPER) != 0;
}

void Gui::begin(std::span<const InputEvent> events, double dt) {
    ImGuiIO& io = ImGui::GetIO();
    const Eigen::Vector2f size = window_.size().cast<float>(), pixels = window_.framebuffer_size().cast<float>();
    io.DisplaySize = {size.x(), size.y()};
    if (size.minCoeff() > 0.0f) io.DisplayFramebufferScale = {pixels.x() / size.x(), pixels.y() / size.y()};
    io.DeltaTime = static_cast<float>(std::max(dt, 1e-4));
    for (const InputEvent& event : events) feed(event);
    fonts_.add_wanted_characters();
    popup_was_open_ = !ImGui::GetCurrentContext()->OpenPopupStack.empty();
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    close_menus_on_escape();
}

/// A menu or a list of choices, but not a question.
bool Gui::menu_is_open() const {
    const ImVector<ImGuiPopupData>& open = ImGui::GetCurrentContext()->OpenPopupStack;
    if (open.empty() || wants_text()) return false;
    const ImGuiWindow* top = open.back().Window;
    return top == nullptr || (top->Flags & ImGuiWindowFlags_Modal) == 0;
}

/// Dear ImGui itself closes them only once the keys have moved about in them.
void Gui::close_menus_on_escape() {
    if (!menu_is_open() || !ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) return;
    ImGui::ClosePopupToLevel(ImGui::GetCurrentContext()->OpenPopupStack.size() - 1, true);
}

void Gui::end() {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    update_cursor_shape();
}

void Gui::recover() { ImGui::ErrorCheckEndFrameRecover(nullptr); }

void Gui::update_cursor_shape() {
    switch (ImGui::GetMouseCursor()) {
        case ImGuiMouseCursor_TextInput:
            window_.set_cursor(Window::CursorShape::text);
            break;
        case ImGuiMouseCursor_Hand:
            window_.set_cursor(Window::CursorShape::hand);
            break;
        case ImGuiMouseCursor_ResizeEW:
            window_.set_cursor(Window::CursorShape::resize_horizontal);
            break;
        case ImGuiMouseCursor_ResizeNS:
            window_.set_cursor(Window::CursorShape::resize_vertical);
            break;
        default:
            window_.set_cursor(Window::CursorShape::arrow);
            break;
    }
}

bool Gui::wants_mouse() const { return ImGui::GetIO().WantCaptureMouse; }
bool Gui::is_in_use() const { return ImGui::IsAnyItemActive(); }

bool Gui::wants_text() const { return ImGui::GetIO().WantTextInput; }
bool Gui::wants_keys() const { return wants_text() || popup_was_open_; }

}  // namespace elastolab
