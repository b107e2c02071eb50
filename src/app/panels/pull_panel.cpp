#include "app/panels/pull_panel.hpp"

#include <imgui.h>

#include <imgui_stdlib.h>

#include <algorithm>
#include <utility>

#include "app/panels/overlays.hpp"
#include "app/panels/panel_context.hpp"
#include "app/panels/widgets.hpp"
#include "app/selection.hpp"
#include "base/text.hpp"

namespace elastolab {

namespace {

/// Of the body's size, of a full turn and of a force: less is rounding.
constexpr double kRoundingPart = 1e-9;

/// The force on a handle that moves by it; true when the typing has ended.
bool draw_grip_force(LiveScene& scene, std::optional<int> handle, float scale) {
    GripForce typed;
    bool by_force = false, ended = false;
    if (handle) {
        const Handle& present = scene.document().handles[static_cast<std::size_t>(*handle)];
        by_force = present.force.has_value();
        if (by_force) typed = *present.force;
        typed.force -= typed.spring * mean_displacement(present.motion, scene.rest_positions(*handle));
        typed.spring = 0.0;  // what a spring pulls with by now
    }
    const bool was_by_force = by_force;
    ImGui::BeginDisabled(!handle);
    if (ImGui::Checkbox("moved by a force", &by_force)) {
        scene.set_force(*handle, by_force ? std::optional(GripForce{}) : std::nullopt);
        ended = true;
    }
    tooltip("The patch stays rigid and goes where this force holds it. Without: it is where it was put.");
    ImGui::EndDisabled();
    ImGui::BeginDisabled(!was_by_force);
    if (draw_numbers("force", typed.force.data(), 3, "", scale, kRoundingPart * typed.force.norm()))
        scene.set_force(*handle, typed);
    ended = ImGui::IsItemDeactivatedAfterEdit() || ended;
    tooltip("Total force on the patch along x, y and z.");
    if (draw_numbers("moment", typed.moment.data(), 3, "", scale, kRoundingPart * typed.moment.norm()))
        scene.set_force(*handle, typed);
    ended = ImGui::IsItemDeactivatedAfterEdit() || ended;
    tooltip("Moment about the middle of the patch.");
    ImGui::EndDisabled();
    return ended;
}

/// How a handle is moved, turned and scaled, as numbers that can be typed. The fields are there where nothing can be
/// typed, too, so that nothing below them moves during a drag.
void draw_placement(ViewerState& state, std::optional<int> handle, float scale) {
    LiveScene& scene = state.scene();
    const Motion motion = handle ? scene.document().handles[static_cast<std::size_t>(*handle)].motion : Motion{};
    const Positions rest = handle ? scene.rest_positions(*handle) : Positions(3, 0);
    const std::optional<Placement> present = handle ? placement_of(motion, rest) : std::nullopt;
    const Eigen::Vector3d moved = handle ? mean_displacement(motion, rest) : Eigen::Vector3d::Zero();
    Placement typed = present.value_or(Placement{.move = moved});
    const double size = (scene.report().max_corner - scene.report().min_corner).norm();
    bool ended = false;
    ImGui::BeginDisabled(!handle);
    if (draw_numbers("move", typed.move.data(), 3, "", scale, kRoundingPart * size))
        scene.set_motion(*handle, translated(motion, typed.move - moved));
    ended = ImGui::IsItemDeactivatedAfterEdit();
    tooltip("Displacement of the middle of the handle along x, y and z [mesh units].");
    ImGui::EndDisabled();
    ImGui::BeginDisabled(!present || rest.cols() < 2);
    if (!present)
        draw_no_numbers("turn", 3, scale);
    else if (draw_numbers("turn", typed.turn.data(), 3, "\u00b0", scale, kRoundingPart * 360.0))
        scene.set_motion(*handle, motion_of(typed, rest));
    ended = ended || ImGui::IsItemDeactivatedAfterEdit();
    tooltip(
        "Rotation vector about the middle of the handle: along the axis, as long as the angle [degrees]. 0, 0, 720: "
        "two full turns about z.");
    if (!present)
        draw_no_numbers("scale", 1, scale);
    else if (draw_numbers("scale", &typed.scale, 1, "", scale) && typed.scale > 0.0)
        scene.set_motion(*handle, motion_of(typed, rest));
    ended = ended || ImGui::IsItemDeactivatedAfterEdit();
    tooltip("Scale about the middle of the handle.");
    ImGui::EndDisabled();
    ended = draw_grip_force(scene, handle, scale) || ended;
    if (ended) scene.commit();
}

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

bool is_very_tall(const PanelContext& context) {
    return context.layout.panel.height >= kVeryTallPanel * context.gui.scale();
}

/// Whether another button with this label fits beside the last one.
bool fits_beside(const char* label) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float end = ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x + style.ItemSpacing.x;
    return end + ImGui::CalcTextSize(label).x + 2.0f * style.FramePadding.x < ImGui::GetContentRegionMax().x;
}

}  // namespace

/// A text field for the name of the selected handle or fixed set; true when the typing has ended.
bool PullPanel::draw_name(const PanelContext& context) {
    ViewerState& state = context.state;
    LiveScene& scene = state.scene();
    const std::optional<Selection> chosen = selection(state);
    const std::string name = selected_name(state);
    std::string typed = typed_name_ && typed_name_->first == chosen ? typed_name_->second : name;
    ImGui::BeginDisabled(!chosen);
    set_item_width(context.gui.scale());
    if (std::exchange(asks_name_, false)) ImGui::SetKeyboardFocusHere();
    const bool entered = ImGui::InputText("name", &typed, ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::EndDisabled();
    typed_name_.reset();
    if (ImGui::IsItemActive() && chosen) typed_name_ = {*chosen, typed};
    typed = one_line(typed);
    const bool ended = entered || ImGui::IsItemDeactivated();
    if (!chosen || !(entered || ImGui::IsItemDeactivatedAfterEdit()) || typed == name) return ended;
    const bool taken =
        chosen->fixed ? scene.rename_fixed_set(chosen->number, typed) : scene.rename_handle(chosen->number, typed);
    if (taken)
        scene.commit();
    else
        state.messages.error("\"" + typed + "\" cannot be used: the name is empty or taken. Type another.");
    return ended;
}

void PullPanel::draw_name_alone(const PanelContext& context) {
    constexpr const char* kTitle = "Rename";
    const bool has_panel = context.layout.panel.width > 0.0;
    if (asks_name_ && !has_panel) ImGui::OpenPopup(kTitle);
    const Viewport& scene = context.layout.scene;
    ImGui::SetNextWindowPos(im_point(scene.center().x(), scene.center().y()), ImGuiCond_Always, {0.5f, 0.5f});
    if (!ImGui::BeginPopup(kTitle, ImGuiWindowFlags_NoMove)) return;
    if (draw_name(context) || has_panel) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

/// Name and placement of the selected handle or fixed set.
void PullPanel::draw_selection(const PanelContext& context) {
    const std::optional<Selection> chosen = selection(context.state);
    ImGui::SetNextItemOpen(is_very_tall(context), ImGuiCond_Once);
    if (asks_name_) ImGui::SetNextItemOpen(true);
    const std::string heading = chosen ? "Selected: " + selected_name(context.state) : "Nothing selected";
    if (!ImGui::TreeNodeEx((heading + "###selection").c_str(), ImGuiTreeNodeFlags_NoTreePushOnOpen)) return;
    ImGui::PushID(chosen ? (chosen->fixed ? LiveScene::kFixed - chosen->number : chosen->number) : -1);
    draw_name(context);
    const bool is_handle = chosen && !chosen->fixed;
    draw_placement(context.state, is_handle ? std::optional(chosen->number) : std::nullopt, context.gui.scale());
    ImGui::PopID();
}

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
            draw_row(vertices_text(scene.handle_name(h), scene.vertices(h)), selected,
                     selected ? context.palette.active : context.palette.handle, context.gui.scale());
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
    const float least = height_of(is_very_tall(context) ? 4.5f : is_low ? 2.5f : 3.5f);
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
    draw_selection(context);
}

void PullPanel::rename_selection(ViewerState& state) {
    if (!selection(state)) return;
    state.display.panel = true;
    asks_name_ = true;
}

}  // namespace elastolab
