#include "app/panels/compare_panel.hpp"

#include <imgui.h>

#include <algorithm>
#include <array>

#include "app/panels/panel_context.hpp"
#include "app/panels/widgets.hpp"
#include "base/text.hpp"
#include "methods/registry.hpp"

namespace elastolab {

namespace {

constexpr std::array<Choice<CompareMode>, 3> kCompareModes = {
    {{CompareMode::off, "one method", "Only the chosen method."},
     {CompareMode::side_by_side, "side by side",
      "C: every method in a view of its own, with the same handles and "
      "camera. Pull in any of them."},
     {CompareMode::ghosts, "as ghosts", "G: the chosen method solid, the others as glass over it."}}};

void draw_kinds(ViewerState& state, const Palette& palette) {
    for (const MethodKind kind : all_methods()) {
        auto& kinds = state.compare.kinds;
        bool shown = kind == state.method || std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
        ImGui::PushStyleColor(ImGuiCol_CheckMark, imgui_colour(palette.body(kind)));
        ImGui::BeginDisabled(kind == state.method);
        if (ImGui::Checkbox(title(kind).c_str(), &shown)) {
            std::erase(kinds, kind);
            if (shown) kinds.push_back(kind);
            state.compare.chosen = true;
        }
        ImGui::EndDisabled();
        ImGui::PopStyleColor();
    }
}

void draw_reference(ViewerState& state, float scale) {
    set_item_width(scale);
    if (!begin_choice("reference", title(state.compare.reference).c_str())) return;
    for (const MethodKind kind : all_methods())
        if (choice_entry(title(kind).c_str(), "Differences are measured from this method.",
                         kind == state.compare.reference))
            state.compare.reference = kind;
    end_choice();
}

void draw_differences(const PanelContext& context) {
    const ViewerState& state = context.state;
    if (!ImGui::BeginTable("differences", 3, ImGuiTableFlags_SizingStretchProp)) return;
    for (const char* heading : {"difference", "rms", "largest"}) {
        ImGui::TableNextColumn();
        ImGui::TextColored(imgui_colour(context.palette.text_dim), "%s", heading);
    }
    for (const MethodKind kind : all_methods()) {
        const ShownBody* shown = state.shown.body(kind);
        if (shown == nullptr) continue;
        ImGui::TableNextColumn();
        ImGui::TextColored(imgui_colour(context.palette.words(kind)), "%s", title(kind).c_str());
        ImGui::TableNextColumn();
        if (!shown->difference()) {
            ImGui::TextUnformatted(kind == state.compare.reference ? "reference" : "...");
            ImGui::TableNextColumn();
            continue;
        }
        ImGui::Text("%.2f %%", 100.0 * shown->difference()->relative_rms);
        ImGui::TableNextColumn();
        ImGui::Text("%.2f %%", 100.0 * shown->difference()->relative_max);
    }
    ImGui::EndTable();
    tooltip(
        "Relative to the reference: root-mean-square and largest difference of the vertices' displacements, over "
        "the root-mean-square and largest displacement of the reference.");
}

}  // namespace

void ComparePanel::draw(const PanelContext& context) {
    ViewerState& state = context.state;
    const float scale = context.gui.scale();
    set_item_width(scale);
    CompareMode mode = state.compare.mode;
    if (choose<CompareMode>("views", mode, kCompareModes))
        state.toggle_comparison(mode == CompareMode::off ? state.compare.mode : mode);
    if (!state.comparing()) return;
    draw_kinds(state, context.palette);
    draw_reference(state, scale);
    bool coloured = state.display.field == Field::difference;
    if (ImGui::Checkbox("colour by difference", &coloured))
        state.display.field = coloured ? Field::difference : Field::none;
    draw_differences(context);
    const std::uint64_t bytes = costs_.memory_of_comparison(state);
    fact("memory, at most", bytes > 0 ? readable_bytes(static_cast<double>(bytes)) : "\u2013",
         context.palette.text_dim);
    tooltip(
        "Memory that the program needs for this comparison: precomputation, K and its inverse if they are computed "
        "later, constrained sets, and estimates of the error.");
}

}  // namespace elastolab
