#include <imgui.h>

#include <algorithm>
#include <span>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"
#include "app/shortcuts.hpp"
#include "base/text.hpp"

namespace elastolab {

namespace {

/// Which of several fixed sets a vertex is of.
std::string set_text(const LiveScene& scene, int vertex) {
    return scene.n_fixed_sets() < 2 ? "" : " in " + scene.fixed_name(scene.fixed_set_of(vertex));
}

std::string left_text(const ViewerState& state) {
    if (state.loading()) return "Opening " + state.loading_file().filename().string() + " ...";
    if (const auto file = state.exported_file(); !file.empty()) return "Writing " + file.filename().string() + " ...";
    const Gestures& gestures = state.gestures;
    if (gestures.hover().vertex >= 0) {
        const int v = gestures.hover().vertex, owner = state.scene().owner(v);
        std::string text = "vertex " + std::to_string(v);
        if (owner == LiveScene::kFixed) text += ", fixed" + set_text(state.scene(), v);
        if (owner >= 0) text += ", of " + state.scene().handle_name(owner);
        const auto n = std::ssize(gestures.hover().patch);
        if (n > 0) text += ", patch of " + count_text(n) + (n == 1 ? " vertex" : " vertices");
        return text;
    }
    return state.scene_title();
}

std::string right_text(const ViewerState& state) {
    const FrameHistory& history = state.measurements.history;
    return formatted("update %.3f ms   frame %.2f ms   ", state.measurements.last_frame.update_ms,
                     history.percentile(&FrameTimes::frame_ms, 0.5)) +
           (state.measurements.timings ? "recording timings   " : "") +
           (state.measurements.recorder ? "recording the interaction   " : "");
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

void Panels::draw_status(const PanelContext& context) {
    const Viewport& place = context.layout.status;
    ImGui::SetNextWindowPos({static_cast<float>(place.x), static_cast<float>(place.y)});
    ImGui::SetNextWindowSize({static_cast<float>(place.width), static_cast<float>(place.height)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {12.0f * context.gui.scale(), 4.0f * context.gui.scale()});
    ImGui::Begin("##status", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::PopStyleVar(2);
    ImGui::TextUnformatted(left_text(context.state).c_str());
    const std::string right = right_text(context.state);
    ImGui::SameLine(static_cast<float>(place.width) - ImGui::CalcTextSize(right.c_str()).x);
    ImGui::TextColored(imgui_colour(context.palette.text_dim), "%s", right.c_str());
    ImGui::End();
}

void Panels::draw_help(const PanelContext& context) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float scale = context.gui.scale();
    ImGui::SetNextWindowPos({0.5f * screen.x, 0.5f * screen.y}, ImGuiCond_Always, {0.5f, 0.5f});
    const std::span<const Shortcut> keys = shortcuts();
    const std::size_t beside_mouse = (keys.size() - gesture_help().size()) / 2;  // so that both columns end alike
    const float rows = static_cast<float>(keys.size() - beside_mouse) + 1.0f;
    const float height = rows * ImGui::GetTextLineHeightWithSpacing() + 2.0f * ImGui::GetFrameHeight();
    ImGui::SetNextWindowSize({std::min(820.0f * scale, screen.x), std::min(height, screen.y)});
    if (ImGui::Begin("Mouse and keys", &context.state.show_help,
                     ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove)) {
        const auto keys_of = [](const Shortcut& shortcut) { return shortcut.keys; };
        if (ImGui::BeginTable("help", 2, ImGuiTableFlags_SizingStretchSame)) {
            ImGui::TableNextColumn();
            draw_help_list("mouse", context, gesture_help(), [](const GestureHelp& help) { return help.gesture; });
            draw_help_list("more keys", context, keys.last(beside_mouse), keys_of);
            ImGui::TableNextColumn();
            draw_help_list("keys", context, keys.first(keys.size() - beside_mouse), keys_of);
            ImGui::EndTable();
        }
    }
    ImGui::End();
}

}  // namespace elastolab
