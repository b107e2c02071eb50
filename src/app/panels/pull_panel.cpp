#include "app/panels/pull_panel.hpp"

#include <imgui.h>

#include <algorithm>

#include "app/panels/panel_context.hpp"
#include "app/panels/widgets.hpp"
#include "app/selection.hpp"
#include "base/text.hpp"

namespace elastolab {

namespace {

/// A line under the row of a handle or fixed set. While nothing is known it stays, so that what is below keeps its
/// place during a drag.
void draw_reaction(const PanelContext& context, const std::string& name) {
    const ViewerState& state = context.state;
    if (!state.shown.wants_reactions()) return;
    std::string line = "force and moment: not computed", more;
    if (const ShownBody* shown = state.shown.body(state.method))
        for (const ShownReaction& reaction : shown->reactions()) {
            if (reaction.name != name) continue;
            const Eigen::Vector3d moment = reaction.moment_about_middle();
            const UnitNames& units = state.display.units;
            line = "force " + number_text(reaction.force.norm()) + units.after_force() + ", moment " +
                   number_text(moment.norm()) + units.after_moment();
            more = "Exerted on the body: force " + vector_text(reaction.force) + ", moment about its middle " +
                   vector_text(moment) + ".";
        }
    if (more.empty())
        more =
            "Not computed yet; or part of the fixed set beside it on the proxy; or the computation failed, as a "
            "warning below then says.";
    ImGui::Indent();
    ImGui::TextColored(imgui_colour(context.palette.text_dim), "%s", line.c_str());
    tooltip(more.c_str());
    ImGui::Unindent();
}

std::string vertices_text(const std::string& name, std::span<const int> vertices) {
    return name + ": " + count_text(std::ssize(vertices)) + (vertices.size() == 1 ? " vertex" : " vertices");
}

std::string handle_text(const LiveScene& scene, int handle) {
    const bool by_force = scene.document().handles[static_cast<std::size_t>(handle)].force.has_value();
    return vertices_text(scene.handle_name(handle), scene.vertices(handle)) + (by_force ? ", moved by a force" : "");
}

/// Whether another button with this label fits beside the last one.
bool fits_beside(const char* label) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float end = ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x + style.ItemSpacing.x;
    return end + ImGui::CalcTextSize(label).x + 2.0f * style.FramePadding.x < ImGui::GetContentRegionMax().x;
}

}  // namespace

/// The row that was drawn last comes into sight when it has become the selection.
void PullPanel::scroll_to(const ViewerState& state, const Selection& row) const {
    if (selection(state) == row && listed_ != row) ImGui::SetScrollHereY();
}

/// The fixed sets, and what each exerts. Brush and box change the one that was selected last, which stays bright when a
/// handle is selected after it.
void PullPanel::draw_fixed_sets(const PanelContext& context) {
    ViewerState& state = context.state;
    LiveScene& scene = state.scene();
    int removed = -1;
    for (int set = 0; set < scene.n_fixed_sets(); ++set) {
        ImGui::PushID(LiveScene::kFixed - set);
        const bool selected = selection(state) == Selection{true, set};
        const bool brushed = set == state.gestures.selected_fixed();
        const RowAnswer answer =
            draw_row(vertices_text(scene.fixed_name(set), scene.fixed_vertices(set)), selected,
                     brushed ? context.palette.fixed_active : context.palette.fixed, context.gui.scale());
        scroll_to(state, {true, set});
        draw_reaction(context, scene.fixed_name(set));
        if (answer.clicked) state.gestures.select_fixed(selected ? -1 : set);
        if (answer.removed) removed = set;
        ImGui::PopID();
    }
    state.remove_fixed_set(removed);
    if (state.gestures.selected_fixed() == scene.n_fixed_sets())
        ImGui::TextColored(imgui_colour(context.palette.fixed_active), "new fixed set: now brush or box");
}

void PullPanel::draw_handles(const PanelContext& context) {
    ViewerState& state = context.state;
    const LiveScene& scene = state.scene();
    int removed = -1;
    for (int h = 0; h < scene.n_handles(); ++h) {
        ImGui::PushID(h);
        const bool selected = selection(state) == Selection{false, h};
        const RowAnswer answer =
            draw_row(handle_text(scene, h), selected, selected ? context.palette.active : context.palette.handle,
                     context.gui.scale());
        scroll_to(state, {false, h});
        draw_reaction(context, scene.handle_name(h));
        if (answer.clicked) state.gestures.select_handle(selected ? -1 : h);
        if (answer.removed) removed = h;
        ImGui::PopID();
    }
    state.remove_handle(removed);
    if (scene.n_handles() == 0) paragraph("No handle yet: press on the body and pull.", context.palette.text_dim);
}

/// Between what it takes at least, whose half line shows that there are more, and what its rows need, as the side panel
/// has room. While something is dragged or pressed it stays.
float PullPanel::held_height(const PanelContext& context) {
    const ViewerState& state = context.state;
    const auto height_of = [](float lines) {
        return lines * ImGui::GetTextLineHeightWithSpacing() + 2.0f * ImGui::GetStyle().WindowPadding.y;
    };
    const bool is_low = is_short(context.layout, context.gui.scale());
    const float least = height_of(is_very_tall(context.layout, context.gui.scale()) ? 4.5f : is_low ? 2.5f : 3.5f);
    if (is_low) return least;
    const float per_row = state.shown.wants_reactions() ? 2.0f : 1.0f;
    const int n_rows = state.scene().n_fixed_sets() + state.scene().n_handles();
    const float needed = std::max(least, height_of(per_row * static_cast<float>(n_rows) + 0.5f));
    if (held_height_ == 0.0f) held_height_ = least;
    if (!state.gestures.dragging() && !ImGui::IsAnyItemActive())
        held_height_ = std::clamp(held_height_ + room_, least, needed);
    return held_height_;
}

/// What is fixed and what is pulled, in a list of its own height: a drag adds to it and takes from it, and nothing
/// below is to move.
void PullPanel::draw_held(const PanelContext& context) {
    ViewerState& state = context.state;
    const std::optional<Selection> chosen = selection(state);
    if (ImGui::BeginChild("held", {0.0f, held_height(context)}, true)) {
        draw_fixed_sets(context);
        draw_handles(context);
    }
    ImGui::EndChild();
    listed_ = chosen;
    if (ImGui::Button("New fixed set")) begin_fixed_set(state);
    tooltip("Shift+N: the next stroke of the brush or box makes a new set, with a name of its own.");
    if (fits_beside("Remove all handles")) ImGui::SameLine();
    ImGui::BeginDisabled(state.scene().n_handles() == 0);
    if (ImGui::Button("Remove all handles")) state.clear_handles();
    ImGui::EndDisabled();
}

void PullPanel::draw(const PanelContext& context, float room) {
    room_ = room;
    draw_tool_settings(context);
    draw_held(context);
}

}  // namespace elastolab
