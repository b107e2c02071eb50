// What the viewer tells, at the upper right of the scene.
#include <imgui.h>

#include <algorithm>
#include <string>

#include "app/panels/overlays.hpp"
#include "app/panels/widgets.hpp"

namespace elastolab {

void draw_messages(const PanelContext& context) {
    Messages& messages = context.state.messages;
    const Viewport& scene = context.layout.scene;
    const float scale = context.gui.scale();
    const float width = std::min(440.0f * scale, static_cast<float>(scene.width) - 20.0f * scale);
    // Below the titles of the viewports: two lines of numbers follow them in a comparison.
    const float title_lines = context.state.comparing() ? 5.0f : 2.2f;
    float y = static_cast<float>(scene.y) + kOverlayMargin * scale + title_lines * ImGui::GetFontSize();
    for (std::size_t i = 0; i < messages.all().size(); ++i) {
        const Messages::Message& message = messages.all()[i];
        ImGui::SetNextWindowPos({static_cast<float>(scene.x + scene.width) - width - kOverlayMargin * scale, y});
        ImGui::SetNextWindowSize({width, 0.0f});
        ImGui::PushStyleColor(ImGuiCol_Border,
                              imgui_colour(message.is_error ? context.palette.bad : context.palette.accent));
        ImGui::Begin(("##message" + std::to_string(i)).c_str(), nullptr,
                     ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoFocusOnAppearing |
                         ImGuiWindowFlags_AlwaysAutoResize);
        ImGui::PopStyleColor();
        paragraph(message.text, context.palette.text);
        const bool dismissed = message.is_error && ImGui::SmallButton("Dismiss");
        y += ImGui::GetWindowHeight() + 6.0f * scale;
        ImGui::End();
        if (dismissed) {
            messages.dismiss(i);
            break;
        }
    }
}

}  // namespace elastolab
