#include <imgui.h>

#include <array>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"

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

/// Position of a handle's own translation, to be typed.
void draw_translation(ViewerState& state, int handle) {
    const Motion& motion = state.scene().document().handles[static_cast<std::size_t>(handle)].motion;
    const auto* affine = std::get_if<AffineMotion>(&motion);
    if (affine == nullptr) return;
    AffineMotion changed = *affine;
    ImGui::SetNextItemWidth(-1.0f);
    if (ImGui::InputScalarN("##translate", ImGuiDataType_Double, changed.translate.data(), 3, nullptr, nullptr,
                            "%.4g") &&
        changed.translate.allFinite())
        state.scene().set_motion(handle, changed);
    if (ImGui::IsItemDeactivatedAfterEdit()) state.scene().commit();
    tooltip("Translation of the selected handle along x, y and z [mesh units].");
}

}  // namespace

void Panels::draw_pull(const PanelContext& context) {
    ViewerState& state = context.state;
    draw_tools(state, context.gui.scale());
    draw_patch(context);
    const LiveScene& scene = state.scene();
    ImGui::TextColored(imgui_colour(context.palette.fixed), "fixed: %s vertices",
                       count_text(std::ssize(scene.vertices(LiveScene::kFixed))).c_str());
    const ShownBody* shown = state.shown.body(state.method);
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
        if (selected) draw_translation(state, h);
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
    if (shown == nullptr || shown->reactions().empty()) return;
    for (const ShownReaction& reaction : shown->reactions())
        fact(("force on " + reaction.name).c_str(), number_text(reaction.force.norm()), context.palette.text_dim);
}

}  // namespace elastolab
