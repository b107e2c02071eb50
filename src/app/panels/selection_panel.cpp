#include "app/panels/selection_panel.hpp"

#include <imgui.h>

#include <imgui_stdlib.h>
#include <algorithm>

#include "app/panels/overlays.hpp"
#include "app/panels/panel_context.hpp"
#include "app/panels/widgets.hpp"
#include "base/text.hpp"

namespace elastolab {

namespace {

/// Of the body's size, of a full turn and of a force: less is rounding.
constexpr double kRoundingPart = 1e-9;

/// The force on a handle that moves by it; true when the typing has ended.
bool draw_grip_force(ViewerState& state, std::optional<int> handle, float scale) {
    LiveScene& scene = state.scene();
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
        if (by_force) {
            state.move_by_force(*handle);
        } else {
            scene.set_force(*handle, std::nullopt);
            ended = true;
        }
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

}  // namespace

/// How a handle is moved, turned and scaled, as numbers that can be typed. The fields are there where nothing can be
/// typed, too, so that nothing below them moves during a drag.
void SelectionPanel::draw_placement(ViewerState& state, std::optional<int> handle, float scale) {
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
    tooltip(("Displacement of the middle of the handle along x, y and z [" + state.display.units.of_length() + "].")
                .c_str());
    ImGui::EndDisabled();
    ImGui::BeginDisabled(!present || rest.cols() < 2);
    if (!present)
        draw_no_numbers("turn", 3, scale);
    else if (draw_numbers("turn", typed.turn.data(), 3, "\u00b0", scale, kRoundingPart * 360.0)) {
        typed.turn *= std::min(1.0, kMostDegrees / std::max(typed.turn.stableNorm(), 1.0));
        scene.set_motion(*handle, motion_of(typed, rest));
    }
    ended = ended || ImGui::IsItemDeactivatedAfterEdit();
    const bool is_other = handle && !present && rest.cols() >= 2;
    constexpr const char* kOther =
        "No turn and no scale from rest are this motion: it is a matrix or displacements of the scene's file, or the "
        "patch was taken hold of where the body was deformed already. The gizmo turns it.";
    tooltip(is_other ? kOther
                     : "Rotation vector about the middle of the handle: along the axis, as long as the angle "
                       "[degrees]. 0, 0, 720: two full turns about z.");
    if (!present)
        draw_no_numbers("scale", 1, scale);
    else if (const auto left = scale_.draw("scale", typed.scale, scale)) {
        ended = true;
        typed.scale = *left;
        if (*left > 0.0)
            scene.set_motion(*handle, motion_of(typed, rest));
        else
            state.messages.error("The scale must be positive. Enter a number above 0; 1 is the size at rest.");
    }
    tooltip(is_other ? kOther : "Scale about the middle of the handle.");
    ImGui::EndDisabled();
    ended = draw_grip_force(state, handle, scale) || ended;
    if (ended) scene.commit();
}

/// A text field for the name of the selected handle or fixed set; true when the typing has ended.
bool SelectionPanel::draw_name(const PanelContext& context) {
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

void SelectionPanel::draw_name_alone(const PanelContext& context) {
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
void SelectionPanel::draw(const PanelContext& context) {
    const std::optional<Selection> chosen = selection(context.state);
    ImGui::SetNextItemOpen(is_very_tall(context.layout, context.gui.scale()), ImGuiCond_Once);
    if (asks_name_) ImGui::SetNextItemOpen(true);
    const std::string heading = chosen ? "Selected: " + selected_name(context.state) : "Nothing selected";
    if (!ImGui::TreeNodeEx((heading + "###selection").c_str(), ImGuiTreeNodeFlags_NoTreePushOnOpen)) return;
    ImGui::PushID(chosen ? (chosen->fixed ? LiveScene::kFixed - chosen->number : chosen->number) : -1);
    draw_name(context);
    const bool is_handle = chosen && !chosen->fixed;
    draw_placement(context.state, is_handle ? std::optional(chosen->number) : std::nullopt, context.gui.scale());
    ImGui::PopID();
}

void SelectionPanel::rename(ViewerState& state) {
    if (!selection(state)) return;
    state.display.panel = true;
    asks_name_ = true;
}

}  // namespace elastolab
