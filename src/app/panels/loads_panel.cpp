#include "app/panels/loads_panel.hpp"

#include <imgui.h>

#include <imgui_stdlib.h>

#include <array>

#include "app/panels/panel_context.hpp"
#include "app/panels/widgets.hpp"
#include "base/overloaded.hpp"
#include "base/text.hpp"

namespace elastolab {

namespace {

constexpr double kStandardGravity = 9.81;
constexpr float kListLines = 3.5f;  ///< half a line shows that there are more

constexpr std::array<Segment, 2> kLoadTools = {
    {{"force",
      "L: press on the body and drag: a force on the patch under the cursor, whose arrow grows with the mouse."},
     {"pressure", "K: paint where a pressure acts; with Shift take the paint off."}}};
constexpr std::array<Tool, 2> kLoadToolOf = {Tool::force, Tool::pressure};

/// Gravity downwards, as the view has it.
Eigen::Vector3d downwards(const ViewerState& state) { return -kStandardGravity * state.camera.up_axis(); }

/// Number fields of a load's size; true while they are typed.
bool draw_value(LoadValue& value, float scale) {
    return std::visit(
        Overloaded{[&](ForceLoad& load) { return draw_numbers("force", load.force.data(), 3, "", scale); },
                   [&](TractionLoad& load) { return draw_numbers("traction", load.traction.data(), 3, "", scale); },
                   [&](PressureLoad& load) { return draw_numbers("pressure", &load.pressure, 1, "", scale); }},
        value);
}

const char* explanation(const LoadValue& value) {
    return std::visit(
        Overloaded{
            [](const ForceLoad&) { return "Total force along x, y and z, spread evenly over the triangles."; },
            [](const TractionLoad&) { return "Force per area along x, y and z."; },
            [](const PressureLoad&) { return "Force per area, against the surface: positive presses into the body."; }},
        value);
}

}  // namespace

void LoadsPanel::draw(const PanelContext& context) {
    draw_tools(context);
    draw_gravity(context);
    draw_list(context);
    draw_selected(context);
}

void LoadsPanel::draw_tools(const PanelContext& context) {
    ViewerState& state = context.state;
    const std::size_t chosen = state.tools.tool == Tool::force ? 0 : state.tools.tool == Tool::pressure ? 1 : 2;
    if (const auto clicked = draw_segments({context.palette.accent, context.palette.panel}, kLoadTools, chosen))
        state.tools.tool = clicked == chosen ? Tool::pull : kLoadToolOf[*clicked];
    draw_numbers("new pressure", &state.tools.pressure, 1, "", context.gui.scale());
    tooltip("What the pressure tool puts on; negative sucks.");
}

/// The fields are there without gravity, too, so that nothing below them moves.
void LoadsPanel::draw_gravity(const PanelContext& context) {
    ViewerState& state = context.state;
    LiveScene& scene = state.scene();
    const float scale = context.gui.scale();
    const double density = scene.document().density;
    bool on = scene.document().gravity.has_value();
    if (ImGui::Checkbox("gravity", &on)) {
        state.finish_gesture();
        scene.set_gravity(on ? std::optional(downwards(state)) : std::nullopt, density);
        state.gestures.select_load(on ? std::optional(LiveScene::kGravity) : std::nullopt);
        scene.commit();
    }
    tooltip(
        "The body's weight: density times acceleration, everywhere inside. Its arrow can be dragged, and turned by "
        "rings.");
    ImGui::BeginDisabled(!on);
    Eigen::Vector3d gravity = scene.document().gravity.value_or(Eigen::Vector3d::Zero());
    if (draw_numbers("g", gravity.data(), 3, "", scale)) scene.set_gravity(gravity, density);
    bool ended = ImGui::IsItemDeactivatedAfterEdit();
    tooltip("Acceleration along x, y and z.");
    if (const auto typed = density_.draw("density", density, scale)) {
        if (*typed > 0.0)
            scene.set_gravity(scene.document().gravity, *typed);
        else
            state.messages.error("The density must be positive. Enter a mass per volume above 0.");
        ended = true;
    }
    tooltip("Mass per volume.");
    ImGui::EndDisabled();
    if (ended) scene.commit();
}

void LoadsPanel::draw_list(const PanelContext& context) {
    ViewerState& state = context.state;
    const LiveScene& scene = state.scene();
    const float height = kListLines * ImGui::GetTextLineHeightWithSpacing() + 2.0f * ImGui::GetStyle().WindowPadding.y;
    int removed = -1;
    if (ImGui::BeginChild("loads", {0.0f, height}, true)) {
        for (int load = 0; load < scene.n_loads(); ++load) {
            ImGui::PushID(load);
            const bool selected = state.gestures.selected_load() == load;
            const std::string text = scene.load_name(load) + ": " + load_text(scene, load, state.display.units);
            const RowAnswer answer =
                draw_row(text, selected, selected ? context.palette.active : context.palette.load, context.gui.scale());
            if (answer.clicked) state.gestures.select_load(selected ? std::nullopt : std::optional(load));
            if (answer.removed) removed = load;
            if (scene.applied_load(load) == nullptr)
                paragraph("no effect: all its triangles are constrained", context.palette.bad);
            ImGui::PopID();
        }
        if (scene.n_loads() == 0 && !scene.document().gravity)
            paragraph("No load yet: choose force or pressure above, then drag on the body.", context.palette.text_dim);
    }
    ImGui::EndChild();
    state.remove_load(removed);
    ImGui::BeginDisabled(scene.n_loads() == 0 && !scene.document().gravity);
    if (ImGui::Button("Remove all loads")) state.clear_loads();
    ImGui::EndDisabled();
}

/// Name and size of the selected load. Their place is kept where none is selected.
void LoadsPanel::draw_selected(const PanelContext& context) {
    ViewerState& state = context.state;
    LiveScene& scene = state.scene();
    const std::optional<int> chosen = state.gestures.selected_load();
    const bool is_load = chosen && *chosen >= 0 && *chosen < scene.n_loads();
    ImGui::PushID(is_load ? *chosen : -1);
    ImGui::BeginDisabled(!is_load);
    draw_name(state, is_load ? *chosen : -1, context.gui.scale());
    LoadValue value = is_load ? scene.document().loads[static_cast<std::size_t>(*chosen)].value : LoadValue{};
    if (draw_value(value, context.gui.scale())) scene.set_load(*chosen, value);
    if (ImGui::IsItemDeactivatedAfterEdit()) scene.commit();
    tooltip(explanation(value));
    ImGui::EndDisabled();
    ImGui::PopID();
}

void LoadsPanel::draw_name(ViewerState& state, int load, float scale) {
    LiveScene& scene = state.scene();
    const std::string name = load >= 0 ? scene.load_name(load) : "";
    std::string typed = typed_name_ && typed_name_->first == load ? typed_name_->second : name;
    set_item_width(scale);
    const bool entered = ImGui::InputText("name", &typed, ImGuiInputTextFlags_EnterReturnsTrue);
    typed_name_.reset();
    if (ImGui::IsItemActive()) typed_name_ = {load, typed};
    typed = one_line(typed);
    if (load < 0 || !(entered || ImGui::IsItemDeactivatedAfterEdit()) || typed == name) return;
    if (scene.rename_load(load, typed))
        scene.commit();
    else
        state.messages.error("\"" + typed + "\" cannot be used: the name is empty or taken. Type another.");
}

}  // namespace elastolab
