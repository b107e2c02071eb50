#include "app/panels/warnings_panel.hpp"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/names.hpp"
#include "app/panels/panel_context.hpp"
#include "app/panels/widgets.hpp"
#include "base/text.hpp"
#include "findings/words.hpp"
#include "methods/registry.hpp"
#include "scene/linear_theory.hpp"
#include "scene/live/theory_gauge.hpp"

namespace elastolab {

namespace {

constexpr float kMostOfPanel = 0.3f;  ///< of its height; more is scrolled to
constexpr const char *kFolded = "+ ", *kUnfolded = "\u2013 ";

std::string name_of_motion(const TheoryError& error) {
    if (error.loads) return "these loads";
    return error.turns ? "this turn" : "this pull";
}

bool too_incompressible_for_turns(const ViewerState& state) {
    return is_too_incompressible_for_turns(state.scene().document().material.poisson_ratio);
}

/// How far linear theory is off for what is shown, in the words of a student; empty where it is hardly off.
std::string theory_words(const ViewerState& state) {
    const std::optional<TheoryError>& error = state.simulation.theory_error();
    if (!error || (!error->crushed && error->relative < kSilentLinearTheory)) return "";
    const std::string motion = name_of_motion(*error), better = title(large_deformation_method());
    if (error->crushed)
        return "Linear theory cannot be right for " + motion + ": " + better +
               " finds no equilibrium, a rubber body would be crushed.";
    return "Linear theory: " + formatted("%.0f", 100.0 * error->relative) + " % off for " + motion + ". " + better +
           " shows what a rubber body does" +
           (too_incompressible_for_turns(state) ? ", with a Poisson's ratio farther from 1/2." : ".");
}

/// The same for a warning whose numbers change from frame to frame.
std::string without_numbers(std::string text) {
    std::erase_if(text, [](char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+'; });
    return text;
}

/// What a window of this width leaves for text [pixels].
float room_in(float width) { return width - 2.0f * ImGui::GetStyle().WindowPadding.x; }

/// Height of a paragraph in a window of this width.
float height_of(const std::string& paragraph, float width) {
    return ImGui::CalcTextSize(paragraph.c_str(), nullptr, false, room_in(width)).y + ImGui::GetStyle().ItemSpacing.y;
}

bool fits_in_a_line(const std::string& text, float width) {
    return text.find('\n') == std::string::npos && ImGui::CalcTextSize(text.c_str()).x <= room_in(width);
}

/// As much of the text as a line of this window holds, and how far something is off before the end of that.
std::string first_line(const std::string& text, float width) {
    std::string line = kFolded + text.substr(0, text.find('\n'));
    if (const std::size_t at = line.find(kAreOffBy); at != std::string::npos)
        line.replace(at, kAreOffBy.size(), kOffBy);
    while (ImGui::CalcTextSize((line + " ...").c_str()).x > room_in(width)) {
        const std::size_t space = line.find_last_of(' ');
        if (space == std::string::npos || space < 3) break;
        line.resize(space);
    }
    return line + " ...";
}

}  // namespace

std::vector<WarningsPanel::Warning> WarningsPanel::present(const ViewerState& state) {
    std::vector<Warning> warnings;
    for (const std::string& problem :
         {state.simulation.problem(state.method), state.shown.reaction_failure(state.method),
          state.shown.section_failure(state.method)})
        if (!problem.empty()) warnings.push_back({problem, true});
    for (const MethodKind other : state.shown_kinds())
        if (const std::string problem = state.simulation.problem(other); other != state.method && !problem.empty())
            warnings.push_back(
                {(problem.find(name(other)) == std::string::npos ? title(other) + ": " : "") + problem, true});
    if (!state.files.copy_failure().empty())
        warnings.push_back({"Changes would be lost if the viewer were killed: " + state.files.copy_failure(), true});
    const std::ptrdiff_t n_problems = std::ssize(warnings);
    Findings findings = state.simulation.embedded(state.method).findings();
    const auto of_mesh = std::stable_partition(findings.begin(), findings.end(),
                                               [](const Finding& one) { return one.kind == FindingKind::coarse_mesh; });
    for (const std::string& text : words(findings)) warnings.push_back({text, false});
    if (const std::string theory = theory_words(state); !theory.empty() && state.method->linear) {
        const TheoryError& error = *state.simulation.theory_error();
        const bool may_switch =
            !too_incompressible_for_turns(state) && state.simulation.problem(large_deformation_method()).empty();
        const bool mesh_is_worse =
            of_mesh != findings.begin() && !error.crushed && findings.front().value > error.relative;
        warnings.insert(warnings.begin() + n_problems + (mesh_is_worse ? of_mesh - findings.begin() : 0),
                        {theory, false, may_switch ? large_deformation_method() : nullptr});
    }
    const std::string& name = state.scene().name();
    for (Warning& warning : warnings)
        if (warning.text.starts_with(name))
            warning.text =
                std::filesystem::path(name).filename().string() + with_titles(warning.text.substr(name.size()));
        else
            warning.text = with_titles(warning.text);
    return warnings;
}

float WarningsPanel::draw(const PanelContext& context) {
    ViewerState& state = context.state;
    const std::pair<std::uint64_t, MethodKind> of(state.scene_number(), state.method);
    if (!ImGui::IsAnyItemActive() || warnings_of_ != of) {
        warnings_ = present(state);
        warnings_of_ = of;
    }
    if (warnings_.empty()) return 0.0f;
    const Viewport& panel = context.layout.panel;
    const auto width = static_cast<float>(panel.width), bottom = static_cast<float>(panel.y + panel.height);
    float wanted = 2.0f * ImGui::GetStyle().WindowPadding.y - ImGui::GetStyle().ItemSpacing.y;
    const auto is_unfolded = [&](const Warning& warning) { return unfolded_.contains(without_numbers(warning.text)); };
    const auto as_shown = [&](const Warning& warning) {
        if (fits_in_a_line(warning.text, width)) return warning.text;
        return is_unfolded(warning) ? kUnfolded + warning.text : first_line(warning.text, width);
    };
    for (const Warning& warning : warnings_)
        wanted += height_of(as_shown(warning), width) + (warning.better ? ImGui::GetFrameHeightWithSpacing() : 0.0f);
    const float height = std::ceil(std::min(wanted, kMostOfPanel * static_cast<float>(panel.height)));
    ImGui::SetNextWindowPos({static_cast<float>(panel.x), bottom - height});
    ImGui::SetNextWindowSize({width, height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, imgui_colour(context.palette.panel_raised));
    ImGui::Begin("##warnings", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
    for (const Warning& warning : warnings_) {
        const std::string shown = as_shown(warning);
        paragraph(shown, warning.is_problem ? context.palette.bad : context.palette.busy);
        if (shown != warning.text) {
            if (!is_unfolded(warning)) tooltip(warning.text.c_str());
            const std::string key = without_numbers(warning.text);
            if (ImGui::IsItemClicked() && unfolded_.erase(key) == 0) unfolded_.insert(key);
        }
        if (!warning.better) continue;
        ImGui::PushStyleColor(ImGuiCol_Button, imgui_colour(context.palette.border));  // not that of this window
        ImGui::PushStyleColor(ImGuiCol_ButtonHovered, imgui_colour(context.palette.accent));
        if (ImGui::Button(("Switch to " + title(warning.better)).c_str())) state.select_method(warning.better);
        ImGui::PopStyleColor(2);
        tooltip(
            "Both theories on a coarse mesh: the largest difference of a displacement, over the largest displacement.");
    }
    ImGui::End();
    return height;
}

}  // namespace elastolab
