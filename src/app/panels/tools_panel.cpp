// The tools of the panel for pulling, and their settings.
#include <imgui.h>

#include <algorithm>
#include <array>
#include <optional>

#include "app/panels/panel_context.hpp"
#include "app/panels/pull_panel.hpp"
#include "app/panels/widgets.hpp"

namespace elastolab {

namespace {

constexpr std::array<Segment, 4> kTools = {
    {{"pull", "V: grab a patch of the body and pull it."},
     {"fix: brush", "B: fixes vertices; with Shift it frees them. A click takes one vertex."},
     {"fix: box", "N: the same for all vertices in a box on the screen."},
     {"probe", "I: shows the values at the vertex under the cursor; a click keeps it (see Probes)."}}};
constexpr std::array<Tool, 4> kToolOf = {Tool::pull, Tool::brush, Tool::box, Tool::probe};

constexpr std::array<Choice<PullMode>, 8> kPullModes = {
    {{PullMode::plane, "in the screen", "Follows the cursor in the plane of the screen."},
     {PullMode::normal, "along the normal", "Along the normal of the surface; also with Shift."},
     {PullMode::axis_x, "along x", "Also with X held down."},
     {PullMode::axis_y, "along y", "Also with Y held down."},
     {PullMode::axis_z, "along z", "Also with Z held down."},
     {PullMode::turn, "turn", "Turns what is pulled about its middle; also with Ctrl or R."},
     {PullMode::scale, "scale", "Up larger, down smaller; also with Alt or S."},
     {PullMode::spring, "through a spring",
      "The cursor pulls a new patch, or one under a force, through a spring: the body gives way. Let go, the patch "
      "keeps the spring's force."}}};

constexpr std::array<Choice<GizmoAxes>, 3> kGizmoAxes = {
    {{GizmoAxes::world, "world axes", "The gizmo moves and turns along x, y and z."},
     {GizmoAxes::surface, "surface axes", "The gizmo's third axis is the normal of the surface at the handle."},
     {GizmoAxes::own, "own axes", "The gizmo's axes are those of the world, turned as the handle was."}}};

void draw_gizmo_settings(ViewerState& state, float scale) {
    constexpr float kLeastChoice = 84.0f;
    ImGui::Checkbox("gizmo", &state.tools.gizmo);
    tooltip("Arrows and rings at the selected handle: drag one to move or turn it; with Ctrl in steps.");
    ImGui::SameLine();
    ImGui::Checkbox("snap", &state.tools.snap);
    tooltip(("Pulls go in steps of " + number_text(snap_length(state.scene())) + " " + state.display.units.of_length() +
             ", 15\u00b0 and 10 %. On the gizmo also with Ctrl.")
                .c_str());
    ImGui::SameLine();
    if (ImGui::GetContentRegionAvail().x < kLeastChoice * scale) ImGui::NewLine();
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
    ImGui::BeginDisabled(!state.tools.gizmo);
    choose<GizmoAxes>("##axes", state.tools.gizmo_axes, kGizmoAxes);
    ImGui::EndDisabled();
}

void draw_patch(ViewerState& state, float scale) {
    const double largest = 0.5 * (state.scene().report().max_corner - state.scene().report().min_corner).norm();
    slider("patch radius", state.tools.patch_radius, 0.0, largest, "%.3g", scale);
    tooltip(
        ("Radius of the patch that a press grabs, in " + state.display.units.of_length() +
         "; keys [ and ]. A single vertex (0) is a point load: how far the body follows then depends on the mesh, and "
         "no two methods agree.")
            .c_str());
    if (state.tools.tool != Tool::pull) return;
    bool springs = state.tools.release == Release::spring_back;
    if (ImGui::Checkbox("let go on release", &springs))
        state.tools.release = springs ? Release::spring_back : Release::pin;
    tooltip("A released patch springs back. Otherwise it stays where it was put.");
}

void draw_pull_settings(ViewerState& state, NumberField& spring, float scale) {
    set_item_width(scale);
    choose<PullMode>("movement", state.tools.pull_mode, kPullModes);
    if (state.tools.pull_mode == PullMode::spring) {
        if (const auto typed = spring.draw("spring", state.tools.spring, scale)) {
            if (*typed > 0.0)
                state.tools.spring = *typed;
            else
                state.messages.error("The spring's stiffness must be positive. Enter a force per length above 0.");
        }
        tooltip("Stiffness of the spring: force per length, above zero.");
    }
    draw_gizmo_settings(state, scale);
    draw_patch(state, scale);
}

void draw_brush_size(ViewerState& state, float scale) {
    slider("brush", state.tools.brush_pixels, 4.0, 120.0, "%.0f pixels", scale);
}

void draw_brush_settings(ViewerState& state, const Colour& dim, float scale) {
    draw_brush_size(state, scale);
    paragraph("Paints fixed vertices; with Shift it frees them. A click takes one vertex.", dim);
}

void draw_box_settings(ViewerState& state, const Colour& dim) {
    bool through = state.tools.box_reach == Reach::through;
    if (ImGui::Checkbox("through the body", &through))
        state.tools.box_reach = through ? Reach::through : Reach::visible;
    tooltip("Takes vertices on the far side as well.");
    paragraph("Fixes the vertices in a box that is drawn on the screen; with Shift it frees them.", dim);
}

}  // namespace

/// The tools and the settings of the chosen one. Those of the others need less room than those for pulling: what they
/// leave stays, so that nothing below moves when another tool is chosen.
void PullPanel::draw_tool_settings(const PanelContext& context) {
    ViewerState& state = context.state;
    const float scale = context.gui.scale();
    const auto chosen =
        static_cast<std::size_t>(std::find(kToolOf.begin(), kToolOf.end(), state.tools.tool) - kToolOf.begin());
    if (const auto clicked = draw_segments({context.palette.accent, context.palette.panel}, kTools, chosen))
        state.tools.tool = kToolOf[*clicked];
    const float top = ImGui::GetCursorPosY();
    switch (state.tools.tool) {
        case Tool::pull:
            draw_pull_settings(state, spring_, scale);
            tool_settings_height_ = ImGui::GetCursorPosY() - top;
            break;
        case Tool::brush:
            draw_brush_settings(state, context.palette.text_dim, scale);
            break;
        case Tool::box:
            draw_box_settings(state, context.palette.text_dim);
            break;
        case Tool::force:
        case Tool::pressure:
            paragraph(state.tools.tool == Tool::force
                          ? "Drag on the body: a force on the patch under the cursor (see Loads)."
                          : "Paint where a pressure acts; with Shift take the paint off (see Loads).",
                      context.palette.text_dim);
            if (state.tools.tool == Tool::force)
                draw_patch(state, scale);
            else
                draw_brush_size(state, scale);
            break;
        case Tool::probe:
            paragraph("Point at a vertex: a card shows its values. A click keeps it (see Probes).",
                      context.palette.text_dim);
            break;
    }
    ImGui::SetCursorPosY(top + tool_settings_height_);
}

}  // namespace elastolab
