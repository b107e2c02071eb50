#include "app/panels/performance_panel.hpp"

#include <imgui.h>

#include <array>
#include <optional>
#include <string>

#include "app/panels/file_questions.hpp"
#include "app/panels/panel_context.hpp"
#include "app/panels/widgets.hpp"
#include "base/memory.hpp"
#include "base/text.hpp"

namespace elastolab {

namespace {

struct Part {
    const char* label;
    double FrameTimes::*value;
    const char* explanation;
};

constexpr std::array<Part, 5> kParts = {
    {{"update", &FrameTimes::update_ms, "Displacements of all shown methods, from the mouse event on."},
     {"upload", &FrameTimes::upload_ms, "Positions, normals and colours, and their transfer to OpenGL."},
     {"draw", &FrameTimes::draw_ms, "Processor time of drawing the scene."},
     {"panels", &FrameTimes::gui_ms, "These panels."},
     {"frame", &FrameTimes::frame_ms, "Everything, with the swap of buffers."}}};

void draw_frames(const PanelContext& context) {
    const FrameHistory& history = context.state.measurements.history;
    if (ImGui::BeginTable("frames", 4, ImGuiTableFlags_SizingStretchProp)) {
        for (const char* heading : {"ms", "last", "median", "95 %"}) {
            ImGui::TableNextColumn();
            ImGui::TextColored(imgui_colour(context.palette.text_dim), "%s", heading);
        }
        for (const Part& part : kParts) {
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(part.label);
            tooltip(part.explanation);
            for (const double value : {context.state.measurements.last_frame.*part.value,
                                       history.percentile(part.value, 0.5), history.percentile(part.value, 0.95)}) {
                ImGui::TableNextColumn();
                ImGui::Text("%.3f", value);
            }
        }
        ImGui::EndTable();
    }
    const std::vector<float> series = history.series(&FrameTimes::frame_ms);
    const double median = history.percentile(&FrameTimes::frame_ms, 0.5);
    const std::string text = formatted("%.0f frames/s", median > 0.0 ? 1000.0 / median : 0.0);
    ImGui::PlotLines("##frames", series.data(), static_cast<int>(series.size()), 0, text.c_str(), 0.0f,
                     static_cast<float>(2.0 * history.percentile(&FrameTimes::frame_ms, 0.95)),
                     {ImGui::GetContentRegionAvail().x, 52.0f * context.gui.scale()});
}

void draw_stages(const PanelContext& context) {
    const MethodRunner& runner = context.state.simulation.runner(context.state.method);
    if (!runner.model()) return;
    const ModelFacts& facts = runner.model()->facts();
    for (const StageTime& stage : facts.stages)
        fact(stage.name.c_str(), readable_seconds(stage.seconds), context.palette.text_dim);
    fact("last preparation", readable_seconds(runner.prepare_seconds()), context.palette.text_dim);
    fact("degrees of freedom", count_text(facts.n_degrees_of_freedom), context.palette.text_dim);
    fact("memory of the model", readable_bytes(static_cast<double>(facts.memory_bytes)), context.palette.text_dim);
    fact("memory of the program, at most", readable_bytes(static_cast<double>(peak_memory_bytes())),
         context.palette.text_dim);
}

void draw_section_cost(const PanelContext& context) {
    const std::optional<ShownScene::SectionCost>& cost = context.state.shown.section_cost();
    if (!cost) return;
    fact("cut, each update", readable_seconds(cost->update_seconds), context.palette.text_dim);
    const std::string points =
        cost->inside.evaluated < cost->inside.points
            ? std::to_string(cost->inside.evaluated) + " of " + std::to_string(cost->inside.points)
            : std::to_string(cost->inside.points);
    fact(("cut, " + points + " interior points").c_str(), readable_seconds(cost->inside.worker_seconds),
         context.palette.text_dim);
}

}  // namespace

void PerformancePanel::draw(const PanelContext& context) {
    ViewerState& state = context.state;
    draw_frames(context);
    if (!state.measurements.timings) {
        if (ImGui::Button("Record timings...")) files_.ask_timings(state);
    } else {
        ImGui::PushStyleColor(ImGuiCol_Button, imgui_colour(context.palette.bad));
        if (ImGui::Button("Stop recording")) state.stop_timings();
        ImGui::PopStyleColor();
        if (state.measurements.timings) {
            ImGui::SameLine();
            ImGui::Text("%d frames", state.measurements.timings->n_rows());
        }
    }
    tooltip("A CSV file with one row for every frame.");
    draw_stages(context);
    draw_section_cost(context);
}

}  // namespace elastolab
