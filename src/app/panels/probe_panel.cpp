#include "app/panels/probe_panel.hpp"

#include <imgui.h>

#include <algorithm>

#include "app/names.hpp"
#include "app/panels/file_questions.hpp"
#include "app/panels/panel_context.hpp"
#include "app/panels/widgets.hpp"

namespace elastolab {

namespace {

/// The values since the probe is kept; returns what they range over.
std::string draw_series(const PanelContext& context, std::size_t probe) {
    const std::vector<float> series = context.state.probes.series(probe, context.state.display.field);
    float low = 0.0f, high = 0.0f;
    std::string range = "plotted once it changes";
    if (series.size() >= 2) {
        const auto [lowest, highest] = std::minmax_element(series.begin(), series.end());
        range = number_text(*lowest) + " to " + number_text(*highest);
        low = std::min(0.0f, *lowest);
        high = *highest;
    }
    ImGui::PlotLines("##series", series.data(), static_cast<int>(series.size()), 0, nullptr, low, high,
                     {ImGui::GetContentRegionAvail().x, 40.0f * context.gui.scale()});
    return range;
}

}  // namespace

void ProbePanel::draw(const PanelContext& context) {
    ViewerState& state = context.state;
    bool probing = state.tools.tool == Tool::probe;
    if (ImGui::Checkbox("point at the body", &probing)) state.tools.tool = probing ? Tool::probe : Tool::pull;
    tooltip("I: shows the values at the vertex under the cursor; a click keeps it.");
    const ShownBody* body = state.shown.body(state.method);
    int forgotten = -1;
    for (std::size_t i = 0; body != nullptr && i < state.probes.vertices().size(); ++i) {
        const int vertex = state.probes.vertices()[i];
        const ProbeValue value = probe(vertex, state.scene().mesh().vertices, *body, state.display.deformation_scale);
        ImGui::PushID(vertex);
        const std::string unit = after_value(value.field ? state.display.field : Field::none, state.display.units);
        fact(("vertex " + std::to_string(vertex)).c_str(),
             number_text(value.field.value_or(value.displacement.norm())) + unit, context.palette.probe);
        const std::string range = draw_series(context, i);
        if (ImGui::SmallButton("forget")) forgotten = vertex;
        ImGui::SameLine();
        ImGui::TextColored(imgui_colour(context.palette.text_dim), "%s", range.c_str());
        ImGui::PopID();
    }
    if (forgotten >= 0) state.probes.toggle(forgotten);
    if (state.probes.vertices().empty())
        return paragraph("No probe yet: press I and click on the body.", context.palette.text_dim);
    if (ImGui::Button("Save CSV...")) files_.ask_probes(state);
    tooltip("Every change since the probes were set: time, position, displacement and the shown value.");
    ImGui::SameLine();
    if (ImGui::Button("Forget all")) state.probes.clear();
}

}  // namespace elastolab
