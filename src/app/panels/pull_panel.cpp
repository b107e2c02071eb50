#include <imgui.h>

#include <imgui_stdlib.h>

#include <array>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"
#include "base/text.hpp"

namespace elastolab {

namespace {

constexpr std::array<Choice<PullMode>, 7> kPullModes = {
    {{PullMode::plane, "in the screen", "Follows the cursor in the plane of the screen."},
     {PullMode::normal, "along the normal", "Along the normal of the surface; also with Shift."},
     {PullMode::axis_x, "along x", "Also with X held down."},
     {PullMode::axis_y, "along y", "Also with Y held down."},
     {PullMode::axis_z, "along z", "Also with Z held down."},
     {PullMode::turn, "turn", "Turns what is pulled about its middle; also with Ctrl or R."},
     {PullMode::scale, "scale", "Up larger, down smaller; also with Alt or S."}}};

constexpr std::array<Choice<GizmoAxes>, 3> kGizmoAxes = {
    {{GizmoAxes::world, "of the world", "The gizmo moves and turns along x, y and z."},
     {GizmoAxes::surface, "of the surface", "Its third axis is the normal of the surface at the handle."},
     {GizmoAxes::own, "of the handle", "Those of the world, turned as the handle was."}}};

void draw_tools(ViewerState& state, float scale) {
    const auto tool = [&](const char* label, Tool value, const char* explanation) {
        if (ImGui::RadioButton(label, state.tools.tool == value)) state.tools.tool = value;
        tooltip(explanation);
    };
    tool("pull", Tool::pull, "V: grab a patch of the body and pull it.");
    ImGui::SameLine();
    tool("fix: brush", Tool::brush,
         "B: hold vertices where they are; with Shift, let them go. A click takes one vertex.");
    ImGui::SameLine();
    tool("fix: box", Tool::box, "N: the same for all vertices in a box on the screen.");
    ImGui::SameLine();
    if (ImGui::GetContentRegionAvail().x < ImGui::CalcTextSize("probe").x + 2.0f * ImGui::GetFrameHeight())
        ImGui::NewLine();
    tool("probe", Tool::probe, "I: shows the values at the vertex under the cursor; a click keeps it (see Probes).");
    if (state.tools.tool == Tool::pull) {
        set_item_width(scale);
        choose<PullMode>("movement", state.tools.pull_mode, kPullModes);
        ImGui::Checkbox("gizmo", &state.tools.gizmo);
        tooltip("Arrows and rings at the selected handle: drag one to move or turn it; with Ctrl in steps.");
        ImGui::SameLine();
        ImGui::Checkbox("snap", &state.tools.snap);
        tooltip(("Pulls go in steps of " + number_text(snap_length(state.scene())) +
                 " mesh units, 15\u00b0 and 10 %. On the gizmo also with Ctrl.")
                    .c_str());
        if (state.tools.gizmo) {
            set_item_width(scale);
            choose<GizmoAxes>("axes", state.tools.gizmo_axes, kGizmoAxes);
        }
    } else if (state.tools.tool == Tool::brush) {
        slider("brush", state.tools.brush_pixels, 4.0, 120.0, "%.0f pixels", scale);
    } else if (state.tools.tool == Tool::box) {
        bool through = state.tools.box_reach == Reach::through;
        if (ImGui::Checkbox("through the body", &through))
            state.tools.box_reach = through ? Reach::through : Reach::visible;
        tooltip("Vertices on the far side, too.");
    }
}

void draw_patch(const PanelContext& context) {
    ViewerState& state = context.state;
    const double largest = 0.5 * (state.scene().report().max_corner - state.scene().report().min_corner).norm();
    slider("patch radius", state.tools.patch_radius, 0.0, largest, "%.3g", context.gui.scale());
    tooltip(
        "The part of the surface that a press takes hold of, in mesh units; keys [ and ]. A single vertex (0) is a "
        "point load: how far the body follows then depends on the mesh, and no two methods agree.");
    bool springs = state.tools.release == Release::spring_back;
    if (ImGui::Checkbox("let go on release", &springs))
        state.tools.release = springs ? Release::spring_back : Release::pin;
    tooltip("Released patches spring back. Otherwise they stay where they were put and hold the body there.");
}

/// Numbers with a label to their right; true while they are typed.
bool draw_numbers(const char* label, double* values, int n, const char* format, float scale) {
    set_item_width(scale);
    return ImGui::InputScalarN(label, ImGuiDataType_Double, values, n, nullptr, nullptr, format);
}

/// Where a handle was moved, turned and scaled to, to be typed.
void draw_placement(ViewerState& state, int handle, float scale) {
    LiveScene& scene = state.scene();
    const std::span<const int> vertices = scene.vertices(handle);
    const Positions rest = scene.mesh().vertices(Eigen::all, std::vector<int>(vertices.begin(), vertices.end()));
    const Motion& motion = scene.document().handles[static_cast<std::size_t>(handle)].motion;
    const std::optional<Placement> present = placement_of(motion, rest);
    const Eigen::Vector3d moved = mean_displacement(motion, rest);
    Placement typed = present.value_or(Placement{.move = moved});
    bool ended = false;
    if (draw_numbers("move", typed.move.data(), 3, "%.4g", scale))
        scene.set_motion(handle, translated(motion, typed.move - moved));
    ended = ImGui::IsItemDeactivatedAfterEdit();
    tooltip("Of the middle of the handle along x, y and z [mesh units].");
    if (present && vertices.size() > 1) {
        if (draw_numbers("turn", typed.turn.data(), 3, "%.4g\u00b0", scale))
            scene.set_motion(handle, motion_of(typed, rest));
        ended = ended || ImGui::IsItemDeactivatedAfterEdit();
        tooltip("About the middle of the handle: about x, then y, then z [degrees].");
        if (draw_numbers("scale", &typed.scale, 1, "%.4g", scale) && typed.scale > 0.0)
            scene.set_motion(handle, motion_of(typed, rest));
        ended = ended || ImGui::IsItemDeactivatedAfterEdit();
        tooltip("About the middle of the handle.");
    }
    if (ended) scene.commit();
}

void draw_reaction(const ShownBody* shown, const std::string& name, const Colour& colour) {
    if (shown == nullptr) return;
    for (const ShownReaction& reaction : shown->reactions()) {
        if (reaction.name != name) continue;
        fact("force", number_text(reaction.force.norm()), colour);
        fact("moment about its middle", number_text(reaction.moment_about_place().norm()), colour);
    }
}

}  // namespace

/// Name, placement and forces of the selected handle.
void Panels::draw_handle(const PanelContext& context, int handle) {
    ViewerState& state = context.state;
    const float scale = context.gui.scale();
    const std::string& name = state.scene().handle_name(handle);
    if (typed_name_.first != handle) typed_name_ = {handle, name};
    set_item_width(scale);
    const bool entered = ImGui::InputText("name", &typed_name_.second, ImGuiInputTextFlags_EnterReturnsTrue);
    if (entered || ImGui::IsItemDeactivatedAfterEdit()) {
        const std::string typed = one_line(typed_name_.second);
        if (typed != name && state.scene().rename_handle(handle, typed))
            state.scene().commit();
        else if (typed != name)
            state.messages.error("\"" + typed +
                                 "\" cannot be the name of a handle: it is empty or taken. Type another.");
    }
    if (!ImGui::IsItemActive()) typed_name_ = {handle, state.scene().handle_name(handle)};
    draw_placement(state, handle, scale);
    draw_reaction(state.shown.body(state.method), state.scene().handle_name(handle), context.palette.text_dim);
}

void Panels::draw_pull(const PanelContext& context) {
    ViewerState& state = context.state;
    draw_tools(state, context.gui.scale());
    draw_patch(context);
    const LiveScene& scene = state.scene();
    ImGui::TextColored(imgui_colour(context.palette.fixed), "fixed: %s vertices",
                       count_text(std::ssize(scene.vertices(LiveScene::kFixed))).c_str());
    draw_reaction(state.shown.body(state.method), "fixed", context.palette.text_dim);
    for (int h = 0; h < scene.n_handles(); ++h) {
        ImGui::PushID(h);
        const bool selected = h == state.gestures.selected_handle();
        const std::string label = scene.handle_name(h) + ": " + count_text(std::ssize(scene.vertices(h))) + " vertices";
        ImGui::PushStyleColor(ImGuiCol_Text, imgui_colour(selected ? context.palette.active : context.palette.handle));
        if (ImGui::Selectable(label.c_str(), selected, 0,
                              {ImGui::GetContentRegionAvail().x - 60.0f * context.gui.scale(), 0}))
            state.gestures.select_handle(selected ? -1 : h);
        ImGui::PopStyleColor();
        ImGui::SameLine();
        const bool removed = ImGui::SmallButton("remove");
        if (selected) draw_handle(context, h);
        ImGui::PopID();
        if (removed) {
            state.remove_handle(h);
            break;
        }
    }
    if (scene.n_handles() == 0)
        paragraph("No handle yet: press on the body and pull.", context.palette.text_dim);
    else if (ImGui::Button("Remove all"))
        state.clear_handles();
    if (const std::string& problem = state.shown.reaction_failure(state.method); !problem.empty())
        paragraph(problem, context.palette.bad);
}

}  // namespace elastolab
