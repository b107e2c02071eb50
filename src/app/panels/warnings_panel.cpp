#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"
#include "findings/words.hpp"

namespace elastolab {

namespace {

constexpr float kMostOfPanel = 0.3f;  ///< of its height; more is scrolled to

/// The warnings of the present answer, with the body's file in place of its whole path.
std::vector<std::string> present_warnings(const ViewerState& state) {
    const std::string& name = state.scene().name();
    std::vector<std::string> warnings = words(state.simulation.embedded(state.method).findings());
    for (std::string& text : warnings)
        if (text.starts_with(name)) text.replace(0, name.size(), std::filesystem::path(name).filename().string());
    return warnings;
}

/// Height of a window in which these paragraphs need no scroll bar.
float height_of(const std::vector<std::string>& paragraphs, float width) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float room = width - 2.0f * style.WindowPadding.x;
    float height = 2.0f * style.WindowPadding.y - style.ItemSpacing.y;
    for (const std::string& text : paragraphs)
        height += ImGui::CalcTextSize(text.c_str(), nullptr, false, room).y + style.ItemSpacing.y;
    return height;
}

}  // namespace

/// At the bottom of the side panel, so that nothing else in it moves when they come and go. While an item is pressed
/// or typed into, they stay as they are, lest they cover it. Returns their height.
float Panels::draw_warnings(const PanelContext& context) {
    const ViewerState& state = context.state;
    const std::pair<std::uint64_t, MethodKind> of(state.scene_number(), state.method);
    if (!ImGui::IsAnyItemActive() || warnings_of_ != of) {
        warnings_ = present_warnings(state);
        warnings_of_ = of;
    }
    if (warnings_.empty()) return 0.0f;
    const Viewport& panel = context.layout.panel;
    const auto width = static_cast<float>(panel.width), bottom = static_cast<float>(panel.y + panel.height);
    const float height =
        std::ceil(std::min(height_of(warnings_, width), kMostOfPanel * static_cast<float>(panel.height)));
    ImGui::SetNextWindowPos({static_cast<float>(panel.x), bottom - height});
    ImGui::SetNextWindowSize({width, height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, imgui_colour(context.palette.panel_raised));
    ImGui::Begin("##warnings", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
    for (const std::string& text : warnings_) paragraph(text, context.palette.busy);
    ImGui::End();
    return height;
}

}  // namespace elastolab
