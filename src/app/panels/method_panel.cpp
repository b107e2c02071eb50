#include "app/panels/method_panel.hpp"

#include <imgui.h>

#include <algorithm>
#include <optional>
#include <string>

#include "app/panels/computation_panel.hpp"
#include "app/panels/panel_context.hpp"
#include "app/panels/widgets.hpp"
#include "base/memory.hpp"
#include "base/text.hpp"
#include "methods/registry.hpp"

namespace elastolab {

namespace {

using State = MethodRunner::State;

constexpr double kLeftOfPassed = 0.2;  ///< the least that is left, over the time that has passed

/// What a person wants to know first: does the body answer, is that the method's own answer, and when will it be. That
/// is predicted only once something answers, as a prediction takes processors that the first answer wants.
template <class CostOf>
std::string state_words(const ViewerState& state, const CostOf& cost_of) {
    const Simulation& simulation = state.simulation;
    const MethodRunner& runner = simulation.runner(state.method);
    const bool previewing = simulation.previewing(state.method);
    if (runner.crushed()) return "no equilibrium: the last one stays";
    if (!state.method->linear && runner.has_set() && runner.state() == State::preparing) {
        if (!state.gestures.dragging()) return previewing ? "preview; finding the exact answer" : "finding the answer";
        return previewing ? "preview is following; exact when the hand rests" : "following";
    }
    switch (runner.state()) {
        case State::idle:
            if (simulation.making_proxy(state.method)) return "making a closed surface to simulate";
            if (simulation.preparing_preview()) return "preparing the preview";
            return runner.has_answer() ? "stopped; the last answer is shown" : "not computed";
        case State::precomputing: {
            if (!previewing && simulation.preparing_preview()) return "preparing the preview";
            const double passed = runner.status().seconds, left = cost_of(state.method).seconds() - passed;
            // What takes longer than predicted will not be there in a moment.
            const std::string when = "in about " + readable_prediction(std::max({left, kLeftOfPassed * passed, 1.0}));
            return previewing ? "preview; exact " + when : "ready " + when;
        }
        case State::preparing:
            return previewing ? "preview; preparing the exact answer" : "preparing the constrained set";
        case State::ready:
            if (!state.method->linear && !runner.answers()) return "exact when the hand rests";
            if (runner.converged()) return state.method->linear ? "ready: pulls are instant" : "exact";
            return "ready, exact to " + number_text(runner.tolerance()) + (runner.converging() ? "; converging" : "");
        case State::failed:
            return "failed";
    }
    return "";
}

const Colour& state_colour(const MethodRunner& runner, const Palette& palette) {
    switch (runner.state()) {
        case State::ready:
            return palette.good;
        case State::failed:
            return palette.bad;
        case State::idle:
            return palette.text_dim;
        default:
            return palette.busy;
    }
}

/// What choosing a method would mean now, before a slow one is begun.
std::string button_words(const ViewerState& state, MethodKind kind, const Cost& cost, std::uint64_t completed_bytes) {
    const MethodRunner& runner = state.simulation.runner(kind);
    if (runner.state() == State::ready) return "ready";
    if (cost.seconds() <= 0.0) return "not begun";
    std::string price =
        readable_prediction(cost.seconds()) + ", " + readable_bytes(static_cast<double>(cost.memory_bytes));
    if (completed_bytes > cost.memory_bytes)
        price += ", with K and its inverse later " + readable_bytes(static_cast<double>(completed_bytes));
    if (cost.memory_bytes > available_memory_bytes()) return "takes " + price + ": does not fit into memory";
    return runner.precomputing() ? "takes " + price : "ready after about " + price;
}

/// A button for each method, underlined with how it is doing.
template <class CostOf, class CompletedOf>
void draw_buttons(const PanelContext& context, const CostOf& cost_of, const CompletedOf& completed_of) {
    ViewerState& state = context.state;
    const float scale = context.gui.scale();
    float longest = 0.0f;
    for (const MethodKind kind : all_methods()) longest = std::max(longest, ImGui::CalcTextSize(title(kind).c_str()).x);
    const float room = ImGui::GetContentRegionAvail().x, gap = ImGui::GetStyle().ItemSpacing.x;
    const int per_row = std::clamp(static_cast<int>((room + gap) / (longest + 4.0f * scale + gap)), 1, 3);
    const auto n = static_cast<float>(per_row);
    const float width = (room - (n - 1.0f) * gap) / n;
    const float height = (is_short(context.layout, scale) ? 1.15f : 1.45f) * ImGui::GetFrameHeight();
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {2.0f * scale, ImGui::GetStyle().FramePadding.y});  // long names
    int number = 0;
    for (const MethodKind kind : all_methods()) {
        if (number++ % per_row > 0) ImGui::SameLine();
        const bool active = kind == state.method;
        const Colour& colour = context.palette.body(kind);
        if (active) {
            ImGui::PushStyleColor(ImGuiCol_Button, imgui_colour(colour));
            ImGui::PushStyleColor(ImGuiCol_ButtonHovered, imgui_colour(colour));
            ImGui::PushStyleColor(ImGuiCol_Text, imgui_colour(dark_palette().wire));
        }
        if (ImGui::Button(title(kind).c_str(), {width, height})) state.select_method(kind);
        if (active) ImGui::PopStyleColor(3);
        if (ImGui::IsItemHovered())
            tooltip(
                ("Key " + std::to_string(number) + ": " + button_words(state, kind, cost_of(kind), completed_of(kind)))
                    .c_str());
        const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
        ImGui::GetWindowDrawList()->AddRectFilled(
            {low.x + 8.0f * scale, high.y - 5.0f * scale}, {high.x - 8.0f * scale, high.y - 2.5f * scale},
            imgui_packed(state_colour(state.simulation.runner(kind), context.palette), active ? 0.0f : 1.0f), scale);
    }
    ImGui::PopStyleVar();
}

/// Whether a method has stopped and will not begin again by itself.
bool must_be_begun(const ViewerState& state) {
    const Simulation& simulation = state.simulation;
    const State now = simulation.runner(state.method).state();
    const bool will_begin =
        now == State::idle && simulation.problem(state.method).empty() &&
        (simulation.waiting() || simulation.preparing_preview() || simulation.making_proxy(state.method));
    return (now == State::idle || now == State::failed) && !will_begin;
}

/// At the right end of the row that is begun.
void draw_from_rest(const PanelContext& context, const MethodRunner& runner) {
    constexpr const char* kLabel = "From rest";
    const float width = ImGui::CalcTextSize(kLabel).x + 2.0f * ImGui::GetStyle().FramePadding.x;
    ImGui::SameLine();
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - width);
    ImGui::BeginDisabled(runner.equilibrium() == nullptr || runner.values().isZero(0.0));
    if (ImGui::Button(kLabel)) context.state.begin_from_rest();
    ImGui::EndDisabled();
    tooltip(
        "Finds the equilibrium again, straight from rest. A body that was pulled to and fro can stay in another one, "
        "as a bent strip can snap to either side.");
}

/// How far a worker is with the model, or with a set of held vertices, and a button that stops it, or one that begins
/// again; between them another button of this text, unless it is empty. The row is there when nothing works, too, so
/// that nothing below moves. Returns whether that other button was pressed.
bool draw_progress(const PanelContext& context, MethodRunner& runner, const std::string& other) {
    const float button = 60.0f * context.gui.scale(), height = ImGui::GetFrameHeight();
    const bool works = runner.precomputing() || runner.completing() || runner.state() == State::preparing;
    if (!works && must_be_begun(context.state)) {
        if (ImGui::Button("Compute")) context.state.simulation.retry(context.state.method);
        return false;
    }
    if (!works) {
        const std::optional<double> error = context.state.simulation.preview_error(context.state.method);
        const std::string text =
            error ? "the preview differed by " + formatted("%.*f", *error < 0.1 ? 1 : 0, 100.0 * *error) + " %" : "";
        ImGui::AlignTextToFramePadding();
        ImGui::TextColored(imgui_colour(context.palette.text_dim), "%s", text.c_str());
        if (!context.state.method->linear) draw_from_rest(context, runner);
        return false;
    }
    const JobStatus status = runner.status();
    constexpr float kBetween = 8.0f, kShortestBar = 40.0f;
    const float others =
        other.empty() ? 0.0f
                      : ImGui::CalcTextSize(other.c_str()).x + 2.0f * ImGui::GetStyle().FramePadding.x + kBetween;
    const float bar = ImGui::GetContentRegionAvail().x - button - kBetween - others;
    ImGui::ProgressBar(static_cast<float>(status.progress), {std::max(bar, kShortestBar), height},
                       other.empty() ? stage_words(status.stage).c_str() : "");
    tooltip((stage_words(status.stage) + "  " + readable_seconds(status.seconds)).c_str());
    bool pressed = false;
    if (!other.empty()) {
        ImGui::SameLine();
        pressed = ImGui::Button(other.c_str());
        tooltip("Exact sooner than the chosen method, which goes on when it is chosen again.");
    }
    ImGui::SameLine();
    if (ImGui::Button("Cancel", {button, 0.0f})) runner.cancel();
    return pressed;
}

}  // namespace

/// Which method is ready, or would be far sooner than one that takes long; null when none.
MethodKind MethodPanel::sooner_method(const ViewerState& state) {
    constexpr double kLong = 4.0, kFarSooner = 3.0;  // seconds; times
    if (state.simulation.runner(state.method).state() != State::precomputing) return nullptr;
    if (state.simulation.preparing_preview()) return nullptr;  // no prediction before the first answer
    const double own = costs_.of(state, state.choices.of(state.method)).seconds();
    if (own < kLong) return nullptr;
    for (const MethodKind kind : all_methods())
        if (state.simulation.runner(kind).model() != nullptr && kind != state.method) return kind;
    const auto seconds = [&](MethodKind kind) {
        const double predicted = costs_.of(state, state.choices.of(kind)).seconds();
        return predicted > 0.0 && state.simulation.problem(kind).empty() ? predicted : own;
    };
    const std::span<const MethodKind> all = all_methods();
    const MethodKind best =
        *std::min_element(all.begin(), all.end(), [&](MethodKind a, MethodKind b) { return seconds(a) < seconds(b); });
    return kFarSooner * seconds(best) > own ? nullptr : best;
}

std::string MethodPanel::sooner_words(const ViewerState& state, MethodKind sooner) {
    if (sooner == nullptr) return "";
    const bool ready = state.simulation.runner(sooner).model() != nullptr;
    return title(sooner) + ": " +
           (ready ? "ready" : "in about " + readable_prediction(costs_.of(state, state.choices.of(sooner)).seconds()));
}

void MethodPanel::draw(const PanelContext& context) {
    ViewerState& state = context.state;
    const Palette& palette = context.palette;
    const auto cost_of = [&](MethodKind kind) { return costs_.of(state, state.choices.of(kind)); };
    draw_buttons(context, cost_of, [&](MethodKind kind) { return costs_.memory_with_completion(state, kind); });
    MethodRunner& runner = state.simulation.runner(state.method);
    const bool previews = state.simulation.previewing(state.method) && runner.state() != State::failed;
    const Colour& colour = previews ? palette.good : state_colour(runner, palette);
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextColored(imgui_colour(colour), "%s", state_words(state, cost_of).c_str());
    ImGui::PopTextWrapPos();
    const MethodKind sooner = sooner_method(state);
    if (draw_progress(context, runner, sooner_words(state, sooner))) state.select_method(sooner);
    draw_computation(context, costs_);
}

}  // namespace elastolab
