#include <imgui.h>

#include <imgui_stdlib.h>

#include <array>
#include <utility>

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

/// How a handle is moved, turned and scaled, as numbers that can be typed. The fields are there where nothing can be
/// typed, too, so that nothing below them moves during a drag.
void draw_placement(ViewerState& state, std::optional<int> handle, float scale) {
    LiveScene& scene = state.scene();
    const Motion motion = handle ? scene.document().handles[static_cast<std::size_t>(*handle)].motion : Motion{};
    const std::vector<int> vertices =
        handle ? std::vector(scene.vertices(*handle).begin(), scene.vertices(*handle).end()) : std::vector<int>{};
    const Positions rest = scene.mesh().vertices(Eigen::all, vertices);
    const std::optional<Placement> present = handle ? placement_of(motion, rest) : std::nullopt;
    const Eigen::Vector3d moved = handle ? mean_displacement(motion, rest) : Eigen::Vector3d::Zero();
    Placement typed = present.value_or(Placement{.move = moved});
    bool ended = false;
    ImGui::BeginDisabled(!handle);
    if (draw_numbers("move", typed.move.data(), 3, "%.4g", scale))
        scene.set_motion(*handle, translated(motion, typed.move - moved));
    ended = ImGui::IsItemDeactivatedAfterEdit();
    tooltip("Of the middle of the handle along x, y and z [mesh units].");
    ImGui::EndDisabled();
    ImGui::BeginDisabled(!present || vertices.size() < 2);
    if (draw_numbers("turn", typed.turn.data(), 3, present ? "%.4g\u00b0" : "\u2013", scale))
        scene.set_motion(*handle, motion_of(typed, rest));
    ended = ended || ImGui::IsItemDeactivatedAfterEdit();
    tooltip("About the middle of the handle: about x, then y, then z [degrees].");
    if (draw_numbers("scale", &typed.scale, 1, present ? "%.4g" : "\u2013", scale) && typed.scale > 0.0)
        scene.set_motion(*handle, motion_of(typed, rest));
    ended = ended || ImGui::IsItemDeactivatedAfterEdit();
    tooltip("About the middle of the handle.");
    ImGui::EndDisabled();
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
    if (more.empty())
        more =
            "Not solved for yet; or, on a simplified body, held together with the set beside it; or it could not be "
            "solved for, "
            "as the warnings below say then.";
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

void Panels::rename_selection(ViewerState& state) {
    if (!state.selection()) return;
    state.display.panel = true;
    asks_name_ = true;
}

/// A text field for the name of the selected handle or fixed set.
void Panels::draw_name(const PanelContext& context) {
    ViewerState& state = context.state;
    LiveScene& scene = state.scene();
    const std::optional<ViewerState::Selection> chosen = state.selection();
    const std::string name = state.selected_name();
    std::string typed = typed_name_ && typed_name_->first == chosen ? typed_name_->second : name;
    ImGui::BeginDisabled(!chosen);
    set_item_width(context.gui.scale());
    if (std::exchange(asks_name_, false)) ImGui::SetKeyboardFocusHere();
    const bool entered = ImGui::InputText("name", &typed, ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::EndDisabled();
    typed_name_.reset();
    if (ImGui::IsItemActive() && chosen) typed_name_ = {*chosen, typed};
    typed = one_line(typed);
    if (!chosen || !(entered || ImGui::IsItemDeactivatedAfterEdit()) || typed == name) return;
    const bool taken =
        chosen->fixed ? scene.rename_fixed_set(chosen->number, typed) : scene.rename_handle(chosen->number, typed);
    if (taken)
        scene.commit();
    else
        state.messages.error("\"" + typed + "\" cannot be used: the name is empty or taken. Type another.");
}

/// Name and placement of the selected handle or fixed set.
void Panels::draw_selection(const PanelContext& context) {
    const std::optional<ViewerState::Selection> chosen = context.state.selection();
    ImGui::SetNextItemOpen(is_very_tall(context), ImGuiCond_Once);
    if (asks_name_) ImGui::SetNextItemOpen(true);
    const std::string heading = chosen ? "Selected: " + context.state.selected_name() : "Nothing selected";
    if (!ImGui::TreeNodeEx((heading + "###selection").c_str(), ImGuiTreeNodeFlags_NoTreePushOnOpen)) return;
    ImGui::PushID(chosen ? (chosen->fixed ? LiveScene::kFixed - chosen->number : chosen->number) : -1);
    draw_name(context);
    const bool is_handle = chosen && !chosen->fixed;
    draw_placement(context.state, is_handle ? std::optional(chosen->number) : std::nullopt, context.gui.scale());
    ImGui::PopID();
}

/// The row that was drawn last comes into sight when it has become the selection.
void Panels::scroll_to(const ViewerState& state, const ViewerState::Selection& row) const {
    if (state.selection() == row && listed_ != row) ImGui::SetScrollHereY();
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
        scroll_to(state, {false, h});
        draw_reaction(context, scene.handle_name(h));
        if (answer.clicked) state.gestures.select_handle(selected ? -1 : h);
        if (answer.removed) removed = h;
        ImGui::PopID();
    }
    state.remove_handle(removed);
    if (scene.n_handles() == 0) paragraph("No handle yet: press on the body and pull.", context.palette.text_dim);
}

/// What is fixed and what is pulled, in a list of its own height: a drag adds to it and takes from it, and nothing
/// below is to move.
void Panels::draw_held(const PanelContext& context) {
    ViewerState& state = context.state;
    const float lines = is_very_tall(context) ? 4.5f : 3.5f;  // half a line shows that there are more
    const float height = lines * ImGui::GetTextLineHeightWithSpacing() + 2.0f * ImGui::GetStyle().WindowPadding.y;
    const std::optional<ViewerState::Selection> chosen = state.selection();
    if (ImGui::BeginChild("held", {0.0f, height}, true)) {
        draw_fixed_sets(context);
        draw_handles(context);
    }
    ImGui::EndChild();
    listed_ = chosen;
    if (ImGui::Button("New fixed set")) state.begin_fixed_set();
    tooltip("Shift+N: the next stroke of the brush or box makes a new set, with a name of its own.");
    if (fits_beside("Remove all handles")) ImGui::SameLine();
    ImGui::BeginDisabled(state.scene().n_handles() == 0);
    if (ImGui::Button("Remove all handles")) state.clear_handles();
    ImGui::EndDisabled();
}

void Panels::draw_pull(const PanelContext& context) {
    ViewerState& state = context.state;
    draw_tools(state, context.gui.scale());
    draw_patch(context);
    draw_held(context);
    draw_selection(context);
}

}  // namespace elastolab
