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

/// How a handle is moved, turned and scaled, as numbers that can be typed.
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

/// A line under the row of a handle or fixed set. While nothing is known it stays, so that what is below keeps its
/// place during a drag.
void draw_reaction(const PanelContext& context, const std::string& name) {
    const ViewerState& state = context.state;
    if (!state.shown.wants_reactions()) return;
    std::string line = "force and moment: not known", more;
    if (const ShownBody* shown = state.shown.body(state.method))
        for (const ShownReaction& reaction : shown->reactions()) {
            if (reaction.name != name) continue;
            const Eigen::Vector3d moment = reaction.moment_about_place();
            line = "force " + number_text(reaction.force.norm()) + ", moment " + number_text(moment.norm());
            more = "What it exerts on the body: force " + vector_text(reaction.force) +
                   ", moment about its middle at rest " + vector_text(moment) + ".";
        }
    if (more.empty()) more = "Not solved for yet, or, on a simplified body, held together with the set beside it.";
    ImGui::Indent();
    ImGui::TextColored(imgui_colour(context.palette.text_dim), "%s", line.c_str());
    tooltip(more.c_str());
    ImGui::Unindent();
}

std::string vertices_text(const std::string& name, std::span<const int> vertices) {
    return name + ": " + count_text(std::ssize(vertices)) + (vertices.size() == 1 ? " vertex" : " vertices");
}

/// What was done to a row of a list of handles or fixed sets.
struct RowAnswer {
    bool clicked = false, removed = false;
};

/// A row that can be selected, with a button at its right that removes what it stands for.
RowAnswer draw_row(const std::string& text, bool selected, const Colour& colour, float scale) {
    ImGui::PushStyleColor(ImGuiCol_Text, imgui_colour(colour));
    const float room = ImGui::GetContentRegionAvail().x - 60.0f * scale;
    const bool clicked = ImGui::Selectable((text + "###row").c_str(), selected, 0, {room, 0});
    ImGui::PopStyleColor();
    if (ImGui::CalcTextSize(text.c_str()).x > room) tooltip(text.c_str());
    ImGui::SameLine();
    return {clicked, ImGui::SmallButton("remove")};
}

/// Begins a fixed set that the next stroke makes, with a tool that makes strokes.
void begin_fixed_set(ViewerState& state) {
    state.gestures.select_fixed(state.scene().n_fixed_sets());
    if (state.tools.tool != Tool::box) state.tools.tool = Tool::brush;
}

void draw_new_fixed_set(const PanelContext& context) {
    ViewerState& state = context.state;
    const bool begun = state.gestures.selected_fixed() == state.scene().n_fixed_sets();
    if (ImGui::Button("New fixed set")) begin_fixed_set(state);
    tooltip("The next stroke of the brush or box makes a new set, with a name of its own.");
    if (!begun || state.scene().n_fixed_sets() == 0) return;
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(imgui_colour(context.palette.fixed_active), "now brush or box");
}

}  // namespace

/// A text field for the name of a handle or a fixed set; `rename` says whether it takes the name.
void Panels::draw_name(const PanelContext& context, int owner, const std::string& name,
                       const std::function<bool(const std::string&)>& rename) {
    ViewerState& state = context.state;
    const auto kept = typed_names_.find(owner);
    std::string typed = kept == typed_names_.end() ? name : kept->second;
    set_item_width(context.gui.scale());
    const bool entered = ImGui::InputText("name", &typed, ImGuiInputTextFlags_EnterReturnsTrue);
    if (ImGui::IsItemActive())
        typed_names_[owner] = typed;
    else
        typed_names_.erase(owner);
    typed = one_line(typed);
    if ((entered || ImGui::IsItemDeactivatedAfterEdit()) && typed != name) {
        if (rename(typed))
            state.scene().commit();
        else
            state.messages.error("\"" + typed + "\" cannot be used: the name is empty or taken. Type another.");
    }
}

/// Name and placement of the selected handle.
void Panels::draw_handle(const PanelContext& context, int handle) {
    LiveScene& scene = context.state.scene();
    draw_name(context, handle, scene.handle_name(handle),
              [&](const std::string& name) { return scene.rename_handle(handle, name); });
    draw_placement(context.state, handle, context.gui.scale());
}

/// The fixed sets, of which brush and box change the selected one, and what each exerts.
void Panels::draw_fixed_sets(const PanelContext& context) {
    ViewerState& state = context.state;
    LiveScene& scene = state.scene();
    int removed = -1;
    for (int set = 0; set < scene.n_fixed_sets(); ++set) {
        ImGui::PushID(LiveScene::kFixed - set);
        const bool selected = set == state.gestures.selected_fixed();
        const RowAnswer answer =
            draw_row(vertices_text(scene.fixed_name(set), scene.fixed_vertices(set)), selected,
                     selected ? context.palette.fixed_active : context.palette.fixed, context.gui.scale());
        draw_reaction(context, scene.fixed_name(set));
        if (answer.clicked) state.gestures.select_fixed(selected ? -1 : set);
        if (selected)
            draw_name(context, LiveScene::kFixed - set, scene.fixed_name(set),
                      [&](const std::string& name) { return scene.rename_fixed_set(set, name); });
        if (answer.removed) removed = set;
        ImGui::PopID();
    }
    state.remove_fixed_set(removed);
    draw_new_fixed_set(context);
}

void Panels::draw_handles(const PanelContext& context) {
    ViewerState& state = context.state;
    const LiveScene& scene = state.scene();
    int removed = -1;
    for (int h = 0; h < scene.n_handles(); ++h) {
        ImGui::PushID(h);
        const bool selected = h == state.gestures.selected_handle();
        const RowAnswer answer =
            draw_row(vertices_text(scene.handle_name(h), scene.vertices(h)), selected,
                     selected ? context.palette.active : context.palette.handle, context.gui.scale());
        draw_reaction(context, scene.handle_name(h));
        if (answer.clicked) state.gestures.select_handle(selected ? -1 : h);
        if (selected) draw_handle(context, h);
        if (answer.removed) removed = h;
        ImGui::PopID();
    }
    state.remove_handle(removed);
    if (scene.n_handles() == 0)
        paragraph("No handle yet: press on the body and pull.", context.palette.text_dim);
    else if (ImGui::Button("Remove all handles"))
        state.clear_handles();
}

void Panels::draw_pull(const PanelContext& context) {
    ViewerState& state = context.state;
    draw_tools(state, context.gui.scale());
    draw_patch(context);
    draw_fixed_sets(context);
    draw_handles(context);
    if (const std::string& problem = state.shown.reaction_failure(state.method); !problem.empty())
        paragraph(problem, context.palette.bad);
}

}  // namespace elastolab
