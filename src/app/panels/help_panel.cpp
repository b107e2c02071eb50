#include "app/panels/help_panel.hpp"

#include <imgui.h>

#include <algorithm>
#include <span>
#include <string_view>
#include <vector>

#include "app/panels/panel_context.hpp"
#include "app/panels/widgets.hpp"
#include "app/shortcuts.hpp"

namespace elastolab {

namespace {

constexpr float kTwoColumns = 640.0f;  ///< width from which both lists fit beside each other [pixels at scale 1]

/// Lines that the entries of a list take, roughly.
std::size_t n_lines(const auto& entries) {
    constexpr std::size_t kCharacters = 40;
    std::size_t n = 0;
    for (const auto& entry : entries) n += 1 + std::string_view(entry.action).size() / kCharacters;
    return n;
}

/// Two columns: what is done with the mouse or keyboard, and what it does.
void draw_help_list(const char* id, const PanelContext& context, const auto& entries, const auto& keys_of) {
    if (!ImGui::BeginTable(id, 2)) return;
    ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, 132.0f * context.gui.scale());
    ImGui::TableSetupColumn("action", ImGuiTableColumnFlags_WidthStretch);
    for (const auto& entry : entries) {
        const std::string keys = keys_of(entry), action = entry.action;
        ImGui::TableNextColumn();
        ImGui::TextColored(imgui_colour(context.palette.accent), "%s", keys.c_str());
        ImGui::TableNextColumn();
        ImGui::TextWrapped("%s", action.c_str());
    }
    ImGui::EndTable();
}

}  // namespace

void draw_help(const PanelContext& context) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float scale = context.gui.scale();
    ImGui::SetNextWindowPos({0.5f * screen.x, 0.5f * screen.y}, ImGuiCond_Always, {0.5f, 0.5f});
    const std::span<const Shortcut> keys = shortcuts();
    const std::vector<GestureHelp> gestures = gesture_help(context.state.tools.navigation);
    const std::size_t of_keys = n_lines(keys), of_mouse = n_lines(gestures);
    const std::size_t beside_mouse =
        of_keys > of_mouse ? (of_keys - of_mouse) / 2 : 0;  // so that both columns end alike
    const float rows = static_cast<float>(std::max(of_mouse + beside_mouse, of_keys - beside_mouse));
    const float height = rows * ImGui::GetTextLineHeightWithSpacing() + 2.0f * ImGui::GetFrameHeight();
    const float width = std::min(820.0f * scale, screen.x);
    const int n_columns = width < kTwoColumns * scale ? 1 : 2;
    ImGui::SetNextWindowSize({width, std::min(height, screen.y)});
    if (ImGui::Begin("Mouse and keys", &context.state.show_help,
                     ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove)) {
        const auto keys_of = [](const Shortcut& shortcut) { return shortcut.keys; };
        if (ImGui::BeginTable("help", n_columns, ImGuiTableFlags_SizingStretchSame)) {
            ImGui::TableNextColumn();
            draw_help_list("mouse", context, gestures, [](const GestureHelp& help) { return help.gesture; });
            draw_help_list("more keys", context, keys.last(beside_mouse), keys_of);
            ImGui::TableNextColumn();
            draw_help_list("keys", context, keys.first(keys.size() - beside_mouse), keys_of);
            ImGui::EndTable();
        }
    }
    ImGui::End();
}

}  // namespace elastolab
