#pragma once

#include <imgui.h>

namespace elastolab {

/// Dear ImGui without a window: frames of one panel, with keys and the mouse as a test has them.
class BareGui {
public:
    BareGui() : context_(ImGui::CreateContext()) {
        ImGui::SetCurrentContext(context_);
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {800.0f, 600.0f};
        io.DeltaTime = 1.0f / 60.0f;
        for (const ImGuiKey key : {ImGuiKey_Enter, ImGuiKey_Escape, ImGuiKey_Space, ImGuiKey_Backspace})
            io.KeyMap[key] = static_cast<int>(key);
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    }
    ~BareGui() { ImGui::DestroyContext(context_); }
    BareGui(const BareGui&) = delete;
    BareGui& operator=(const BareGui&) = delete;

    template <class Draw>
    void frame(const Draw& draw) {
        ImGui::NewFrame();
        draw();
        ImGui::Render();
    }
    /// A key that is down for one frame.
    template <class Draw>
    void press(ImGuiKey key, const Draw& draw) {
        ImGui::GetIO().KeysDown[static_cast<int>(key)] = true;
        frame(draw);
        ImGui::GetIO().KeysDown[static_cast<int>(key)] = false;
        frame(draw);
    }
    template <class Draw>
    void type(const char* text, const Draw& draw) {
        ImGui::GetIO().AddInputCharactersUTF8(text);
        frame(draw);
    }
    template <class Draw>
    void click(const ImVec2& place, const Draw& draw) {
        ImGui::GetIO().MousePos = place;
        frame(draw);
        for (const bool down : {true, false}) {
            ImGui::GetIO().MouseDown[0] = down;
            frame(draw);
        }
    }

private:
    ImGuiContext* context_;
};

}  // namespace elastolab
