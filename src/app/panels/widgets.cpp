#include "app/panels/widgets.hpp"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "base/text.hpp"

namespace elastolab {

namespace {

constexpr float kLabelRoom = 112.0f, kLeastItem = 84.0f, kMostItem = 220.0f;  ///< widths: beside an item, and of it

}  // namespace

std::string count_text(long long count) {
    std::string digits = std::to_string(count);
    for (auto i = static_cast<std::ptrdiff_t>(digits.size()) - 3; i > 0; i -= 3)
        digits.insert(static_cast<std::size_t>(i), "\u202f");
    return digits;
}

std::string number_text(double value) { return std::abs(value) < 1e-300 ? "0" : readable_number(value, 3); }

std::string vector_text(const Eigen::Vector3d& v) {
    return "(" + number_text(v.x()) + ", " + number_text(v.y()) + ", " + number_text(v.z()) + ")";
}

ImVec4 imgui_colour(const Colour& colour, float opacity) { return {colour.r, colour.g, colour.b, colour.a * opacity}; }

unsigned imgui_packed(const Colour& colour, float opacity) {
    return ImGui::ColorConvertFloat4ToU32(imgui_colour(colour, opacity));
}

void tooltip(const char* text) {
    if (text == nullptr || *text == '\0' || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 22.0f);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void paragraph(const std::string& text, const Colour& colour) {
    ImGui::PushStyleColor(ImGuiCol_Text, imgui_colour(colour));
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

void fact(const char* label, const std::string& value, const Colour& label_colour) {
    ImGui::TextColored(imgui_colour(label_colour), "%s", label);
    const float width = ImGui::CalcTextSize(value.c_str()).x;
    ImGui::SameLine(std::max(ImGui::GetContentRegionMax().x - width, ImGui::CalcTextSize(label).x + 24.0f));
    ImGui::TextUnformatted(value.c_str());
}

void set_item_width(float scale) {
    const float room = ImGui::GetContentRegionAvail().x - kLabelRoom * scale;
    ImGui::SetNextItemWidth(std::clamp(room, kLeastItem * scale, kMostItem * scale));
}

bool slider(const char* label, double& value, double low, double high, const char* format, float scale) {
    set_item_width(scale);
    return ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &low, &high, format, ImGuiSliderFlags_AlwaysClamp);
}

bool slider(const char* label, int& value, int low, int high, const char* format, float scale) {
    set_item_width(scale);
    return ImGui::SliderInt(label, &value, low, high, format, ImGuiSliderFlags_AlwaysClamp);
}

bool factor_slider(const char* label, double& value, double low, double high, const char* format, float scale) {
    set_item_width(scale);
    return ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &low, &high, format,
                               ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
}

bool begin_choice(const char* label, const char* preview) { return ImGui::BeginCombo(label, preview); }

bool choice_entry(const char* label, const char* explanation, bool selected) {
    const bool clicked = ImGui::Selectable(label, selected);
    tooltip(explanation);
    if (selected) ImGui::SetItemDefaultFocus();
    return clicked;
}

void end_choice() { ImGui::EndCombo(); }

}  // namespace elastolab
