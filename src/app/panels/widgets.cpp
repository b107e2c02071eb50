#include "app/panels/widgets.hpp"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "app/panels/typed_number.hpp"
#include "base/text.hpp"

namespace elastolab {

namespace {

float width_of_text(const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; }

constexpr float kLabelRoom = 112.0f, kLeastItem = 84.0f, kMostItem = 220.0f;  ///< widths: beside an item, and of it

/// The width that these segments leave free in a row [pixels]; negative where they do not fit.
float left_in_row(std::span<const Segment> segments) {
    const float spacing = ImGui::GetStyle().ItemSpacing.x;
    float left = ImGui::GetContentRegionAvail().x + spacing;
    for (const Segment& segment : segments) left -= ImGui::CalcTextSize(segment.label).x + spacing;
    return left;
}

/// How many segments to put into a row, so that all rows have about as many and `padding` is beside each label.
std::size_t segments_per_row(std::span<const Segment> segments, float padding) {
    const auto fits = [&](std::size_t per_row) {
        for (std::size_t first = 0; first < segments.size(); first += per_row) {
            const auto row = segments.subspan(first, std::min(per_row, segments.size() - first));
            if (left_in_row(row) < padding * static_cast<float>(row.size())) return false;
        }
        return true;
    };
    std::size_t n_rows = 1;
    const auto per_row = [&] { return (segments.size() + n_rows - 1) / n_rows; };
    while (per_row() > 1 && !fits(per_row())) ++n_rows;
    return per_row();
}

bool draw_segment(const SegmentColours& colours, const Segment& segment, float width, bool chosen) {
    if (chosen) {
        for (const ImGuiCol colour : {ImGuiCol_Button, ImGuiCol_ButtonHovered, ImGuiCol_ButtonActive})
            ImGui::PushStyleColor(colour, imgui_colour(colours.face));
        ImGui::PushStyleColor(ImGuiCol_Text, imgui_colour(colours.text));
    }
    const bool clicked = ImGui::Button(segment.label, {width, 0.0f});
    if (chosen) ImGui::PopStyleColor(4);
    tooltip(segment.explanation);
    return clicked;
}

}  // namespace

std::string count_text(long long count) {
    std::string digits = std::to_string(count);
    for (auto i = static_cast<std::ptrdiff_t>(digits.size()) - 3; i > 0; i -= 3)
        digits.insert(static_cast<std::size_t>(i), "\u202f");
    return digits;
}

std::string number_text(double value) {
    constexpr double kLimit = 99950.0;  // beyond, three digits are few for all the zeros behind them
    if (std::abs(value) < 1e-300) return "0";
    const std::string digits = readable_number(value, 3);
    return reads_as_whole(value, kLimit) ? formatted("%.0f", std::stod(digits)) : digits;
}

std::string vector_text(const Eigen::Vector3d& v) {
    constexpr double kNoise = 1e-9;  // of the largest component; less is rounding
    const auto text = [&](double x) { return number_text(std::abs(x) < kNoise * v.cwiseAbs().maxCoeff() ? 0.0 : x); };
    return "(" + text(v.x()) + ", " + text(v.y()) + ", " + text(v.z()) + ")";
}

ImVec4 imgui_colour(const Colour& colour, float opacity) { return {colour.r, colour.g, colour.b, colour.a * opacity}; }

unsigned imgui_packed(const Colour& colour, float opacity) {
    return ImGui::ColorConvertFloat4ToU32(imgui_colour(colour, opacity));
}

std::string broken_at_spaces(const std::string& text, float width,
                             const std::function<float(const std::string&)>& width_of) {
    std::string broken, line;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find_first_of(" \n", begin), text.size());
        const std::string word = text.substr(begin, end - begin);
        if (!line.empty() && width_of(line + ' ' + word) > width) {
            broken += line + '\n';
            line.clear();
        } else if (!line.empty()) {
            line += ' ';
        }
        line += word;
        if (end < text.size() && text[end] == '\n') broken += std::exchange(line, {}) + '\n';
        begin = end + 1;
    }
    return broken + line;
}

void tooltip(const char* text) {
    if (text == nullptr || *text == '\0' || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, 1.0f);  // also beside what is disabled, which is pale
    ImGui::BeginTooltip();
    const float width = ImGui::GetFontSize() * 22.0f;
    ImGui::TextUnformatted(broken_at_spaces(text, width, width_of_text).c_str());
    ImGui::EndTooltip();
    ImGui::PopStyleVar();
}

void paragraph(const std::string& text, const Colour& colour) {
    ImGui::PushStyleColor(ImGuiCol_Text, imgui_colour(colour));
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(broken_at_spaces(text, ImGui::GetContentRegionAvail().x, width_of_text).c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

void fact(const char* label, const std::string& value, const Colour& label_colour) {
    ImGui::TextColored(imgui_colour(label_colour), "%s", label);
    const float width = ImGui::CalcTextSize(value.c_str()).x;
    ImGui::SameLine(std::max(ImGui::GetContentRegionMax().x - width, ImGui::CalcTextSize(label).x + 24.0f));
    ImGui::TextUnformatted(value.c_str());
}

std::optional<std::size_t> draw_segments(const SegmentColours& colours, std::span<const Segment> segments,
                                         std::size_t chosen) {
    std::optional<std::size_t> clicked;
    const float padding = ImGui::GetStyle().FramePadding.x;
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0.0f, ImGui::GetStyle().FramePadding.y});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.5f * padding, ImGui::GetStyle().ItemSpacing.y});
    const std::size_t per_row = segments_per_row(segments, padding);
    for (std::size_t first = 0; first < segments.size(); first += per_row) {
        const auto row = segments.subspan(first, std::min(per_row, segments.size() - first));
        const float beside = std::max(0.0f, left_in_row(row)) / static_cast<float>(row.size());
        for (std::size_t i = 0; i < row.size(); ++i) {
            const float width = ImGui::CalcTextSize(row[i].label).x + beside;
            if (i > 0) ImGui::SameLine();
            if (draw_segment(colours, row[i], width, first + i == chosen)) clicked = first + i;
        }
    }
    ImGui::PopStyleVar(2);
    return clicked;
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

namespace {

/// n items of equal width with a label to their right.
void draw_fields(const char* label, int n, const auto& draw_field) {
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x, whole = ImGui::CalcItemWidth();
    const float width = std::max(1.0f, std::floor((whole - gap * static_cast<float>(n - 1)) / static_cast<float>(n)));
    ImGui::BeginGroup();
    ImGui::PushID(label);
    for (int i = 0; i < n; ++i) {
        if (i > 0) ImGui::SameLine(0.0f, gap);
        const bool is_last = i + 1 == n;
        ImGui::SetNextItemWidth(is_last ? std::max(1.0f, whole - (width + gap) * static_cast<float>(n - 1)) : width);
        ImGui::PushID(i);
        draw_field(i, width - 2.0f * ImGui::GetStyle().FramePadding.x);
        ImGui::PopID();
    }
    ImGui::PopID();
    ImGui::SameLine(0.0f, gap);
    ImGui::TextUnformatted(label);
    ImGui::EndGroup();
}

/// The longest that fits, as a format of Dear ImGui: without an exponent where that is as short.
std::string format_for(double value, const std::string& unit, float room) {
    if (reads_as_whole(value)) return "%.0f" + unit;
    for (const char* format : {"%.4g", "%.3g", "%.2g"})
        if (ImGui::CalcTextSize((formatted(format, value) + unit).c_str()).x <= room) return format + unit;
    return "%.1g" + unit;
}

}  // namespace

namespace {

constexpr std::size_t kLongestNumber = 64;

/// A field of Dear ImGui for a number, which takes what typed_number() does; true when it was typed into. What is no
/// number has no value of its own, nor that of its beginning: it is then what it was before.
bool number_field(const char* label, double& value, const std::string& format, const std::string& unit) {
    static double before = 0.0;  // of the field that is typed into
    static bool is_number = true;
    std::array<char, kLongestNumber> text{};
    formatted(format.c_str(), value).copy(text.data(), text.size() - 1);
    const bool edited = ImGui::InputText(label, text.data(), text.size(), ImGuiInputTextFlags_AutoSelectAll);
    if (ImGui::IsItemActivated()) {
        before = value;
        is_number = true;
    }
    if (edited) {
        const std::optional<double> typed = typed_number(text.data(), unit, before);
        is_number = typed.has_value();
        value = typed.value_or(before);
    }
    if (ImGui::IsItemActive() && !is_number) ImGui::SetTooltip("no number that can be used here");
    return edited;
}

}  // namespace

bool draw_number(const char* label, double& value) { return number_field(label, value, "%.5g", ""); }

bool draw_numbers(const char* label, double* values, int n, const char* unit, float scale, double noise) {
    // What the field that is typed into held, and its text, which has fewer digits.
    static double before = 0.0, before_as_text = 0.0;
    set_item_width(scale);
    bool typed = false;
    draw_fields(label, n, [&](int i, float room) {
        double shown = std::abs(values[i]) <= noise ? 0.0 : values[i];
        const std::string format = format_for(shown, unit, room);
        const bool is_typed = number_field("", shown, format, unit);
        if (ImGui::IsItemActivated()) {
            before = values[i];
            before_as_text = std::strtod(formatted(format.c_str(), values[i]).c_str(), nullptr);
        }
        if (!ImGui::IsItemActive() && !reads_as_whole(shown)) tooltip((readable_number(shown, 6) + unit).c_str());
        if (!is_typed) return;
        values[i] = shown == before_as_text ? before : shown;  // as by Esc
        typed = true;
    });
    return typed;
}

std::optional<double> NumberField::draw(const char* label, double value, float scale) {
    double number = typed_.value_or(value);
    if (draw_numbers(label, &number, 1, "", scale)) typed_ = number;
    const bool counts = ImGui::IsItemDeactivatedAfterEdit() && typed_ != value;
    const std::optional<double> typed = typed_;
    if (!ImGui::IsItemActive()) typed_.reset();
    return counts ? typed : std::nullopt;
}

void draw_no_numbers(const char* label, int n, float scale) {
    set_item_width(scale);
    double nothing = 0.0;
    draw_fields(label, n, [&](int, float) {
        ImGui::InputDouble("", &nothing, 0.0, 0.0, "\u2013", ImGuiInputTextFlags_ReadOnly);
    });
}

RowAnswer draw_row(const std::string& text, bool selected, const Colour& colour, float scale) {
    ImGui::PushStyleColor(ImGuiCol_Text, imgui_colour(colour));
    const float room = ImGui::GetContentRegionAvail().x - 60.0f * scale;
    const bool clicked = ImGui::Selectable((text + "###row").c_str(), selected, 0, {room, 0});
    ImGui::PopStyleColor();
    if (ImGui::CalcTextSize(text.c_str()).x > room) tooltip(text.c_str());
    ImGui::SameLine();
    return {clicked, ImGui::SmallButton("remove")};
}

}  // namespace elastolab
