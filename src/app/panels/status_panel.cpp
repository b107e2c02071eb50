#include "app/panels/status_panel.hpp"

#include <imgui.h>

#include <string>

#include "app/panels/panel_context.hpp"
#include "app/panels/widgets.hpp"
#include "base/text.hpp"

namespace elastolab {

namespace {

/// Which of several fixed sets a vertex is of.
std::string set_text(const LiveScene& scene, int vertex) {
    return scene.n_fixed_sets() < 2 ? "" : " in " + scene.fixed_name(scene.fixed_set_of(vertex));
}

std::string left_text(const ViewerState& state) {
    if (state.files.loading()) return "Opening " + state.files.loading_file().filename().string() + " ...";
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
    return state.files.title();
}

std::string right_text(const ViewerState& state) {
    const FrameHistory& history = state.measurements.history;
    return formatted("update %.3f ms   frame %.2f ms   ", state.measurements.last_frame.update_ms,
                     history.percentile(&FrameTimes::frame_ms, 0.5)) +
           (state.measurements.timings ? "recording timings   " : "") +
           (state.measurements.recorder ? "recording the interaction   " : "");
}

}  // namespace

void draw_status(const PanelContext& context) {
    const Viewport& place = context.layout.status;
    ImGui::SetNextWindowPos({static_cast<float>(place.x), static_cast<float>(place.y)});
    ImGui::SetNextWindowSize({static_cast<float>(place.width), static_cast<float>(place.height)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {12.0f * context.gui.scale(), 4.0f * context.gui.scale()});
    ImGui::Begin("##status", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::PopStyleVar(2);
    const std::string left = left_text(context.state), right = right_text(context.state);
    const float begin = static_cast<float>(place.width) - ImGui::CalcTextSize(right.c_str()).x;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float end = static_cast<float>(place.x) + begin - ImGui::GetStyle().ItemSpacing.x;
    ImGui::PushClipRect(at, {end, at.y + ImGui::GetTextLineHeightWithSpacing()}, true);
    ImGui::TextUnformatted(left.c_str());
    ImGui::PopClipRect();
    if (at.x + ImGui::CalcTextSize(left.c_str()).x > end) tooltip(left.c_str());
    ImGui::SameLine(begin);
    ImGui::TextColored(imgui_colour(context.palette.text_dim), "%s", right.c_str());
    ImGui::End();
}

}  // namespace elastolab
