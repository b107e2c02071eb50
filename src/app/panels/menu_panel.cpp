#include "app/panels/menu_panel.hpp"

#include <imgui.h>

#include <array>
#include <string>
#include <utility>

#include "app/panels/body_panel.hpp"
#include "app/panels/export_panel.hpp"
#include "app/panels/file_questions.hpp"
#include "app/panels/panel_context.hpp"
#include "app/panels/picture_panel.hpp"
#include "app/panels/selection_panel.hpp"
#include "app/panels/widgets.hpp"
#include "app/selection.hpp"
#include "mesh/primitives.hpp"

namespace elastolab {

namespace {

void draw_recent(ViewerState& state) {
    if (!ImGui::BeginMenu("Open recent", !state.files.recent().empty())) return;
    for (const std::filesystem::path& file : std::vector(state.files.recent()))
        if (ImGui::MenuItem(file.string().c_str())) state.files.open(file);
    ImGui::EndMenu();
}

void draw_directions(ViewerState& state) {
    struct Direction {
        const char *label, *keys;
        ViewDirection direction;
    };
    constexpr std::array<Direction, 7> kDirections = {{{"Oblique", "", ViewDirection::isometric},
                                                       {"Front", "Num 1", ViewDirection::front},
                                                       {"Back", "Ctrl+Num 1", ViewDirection::back},
                                                       {"Left", "Ctrl+Num 3", ViewDirection::left},
                                                       {"Right", "Num 3", ViewDirection::right},
                                                       {"Top", "Num 7", ViewDirection::top},
                                                       {"Bottom", "Ctrl+Num 7", ViewDirection::bottom}}};
    for (const auto& [label, keys, direction] : kDirections)
        if (ImGui::MenuItem(label, keys)) state.camera.set_view(direction);
}

void draw_navigation(ViewerState& state) {
    constexpr std::array<std::pair<const char*, Navigation>, 5> kPresets = {{{"Standard", Navigation::standard},
                                                                             {"as in Blender", Navigation::blender},
                                                                             {"as in ParaView", Navigation::paraview},
                                                                             {"as in polyscope", Navigation::polyscope},
                                                                             {"Trackpad", Navigation::trackpad}}};
    if (!ImGui::BeginMenu("Mouse")) return;
    for (const auto& [label, navigation] : kPresets) {
        if (ImGui::MenuItem(label, nullptr, state.tools.navigation == navigation)) state.tools.navigation = navigation;
        const auto [turn, move, zoom] = view_help(navigation);
        tooltip(
            (std::string("To turn the view: ") + turn + ". To move it: " + move + ". To zoom: " + zoom + ".").c_str());
    }
    ImGui::EndMenu();
}

void draw_view(ViewerState& state) {
    if (!ImGui::BeginMenu("View")) return;
    if (ImGui::MenuItem("Frame the body", "F")) state.frame_body();
    if (ImGui::MenuItem("Frame the selection", "Shift+F", false, selection(state).has_value())) frame_selection(state);
    draw_directions(state);
    ImGui::Separator();
    for (const auto& [label, axis] : {std::pair{"Y is up", 1}, std::pair{"Z is up", 2}})
        if (ImGui::MenuItem(label, nullptr, state.camera.up_axis()[axis] == 1.0)) {
            state.camera.set_up_axis(Eigen::Vector3d::Unit(axis));
            state.camera.set_view(ViewDirection::isometric);
        }
    const bool is_flat = state.camera.projection_kind() == Projection::orthographic;
    if (ImGui::MenuItem("Orthographic", "O", is_flat)) toggle_projection(state.camera);
    draw_navigation(state);
    ImGui::Separator();
    if (ImGui::MenuItem("Side panel", "P", state.display.panel)) state.display.panel = !state.display.panel;
    if (ImGui::MenuItem("Light theme", "T", !state.display.dark)) state.display.dark = !state.display.dark;
    for (const int percent : {80, 100, 125, 150, 200})
        if (const float scale = 0.01f * static_cast<float>(percent); ImGui::MenuItem(
                ("Size " + std::to_string(percent) + " %").c_str(), nullptr, state.display.ui_scale == scale))
            state.display.ui_scale = scale;
    ImGui::EndMenu();
}

}  // namespace

void MenuPanel::draw_file(ViewerState& state, float scale) {
    if (!ImGui::BeginMenu("File")) return;
    if (ImGui::MenuItem("Open...", "Ctrl+O")) panels_.files.ask_open(state);
    draw_recent(state);
    examples_.draw(state, scale);
    if (ImGui::BeginMenu("New body")) {
        for (const std::string& name : primitive_names())
            if (ImGui::MenuItem(name.c_str())) panels_.body.make(state, name);
        ImGui::EndMenu();
    }
    ImGui::Separator();
    if (ImGui::MenuItem("Save scene", "Ctrl+S")) panels_.files.save(state);
    if (ImGui::MenuItem("Save scene as...", "Ctrl+Shift+S")) panels_.files.save_as(state);
    draw_export_menu(state, panels_.files);
    if (ImGui::MenuItem("Picture or film...")) panels_.picture.ask();
    if (ImGui::MenuItem("Screenshot of the window...")) panels_.files.ask_screenshot(state);
    ImGui::Separator();
    if (ImGui::MenuItem("Quit", "Ctrl+Q")) state.quit();
    ImGui::EndMenu();
}

void MenuPanel::draw_edit(ViewerState& state) {
    if (!ImGui::BeginMenu("Edit")) return;
    const LiveScene& scene = state.scene();
    const std::string name = selected_name(state), quoted = name.empty() ? "the selection" : "\"" + name + "\"";
    if (ImGui::MenuItem("Undo", "Ctrl+Z", false, state.scene().can_undo())) state.undo();
    if (ImGui::MenuItem("Redo", "Ctrl+Y", false, state.scene().can_redo())) state.redo();
    ImGui::Separator();
    if (ImGui::MenuItem("Select the next handle", "H", false, scene.n_handles() > 0)) select_next_handle(state);
    if (ImGui::MenuItem("Select the next fixed set", "J", false, scene.n_fixed_sets() > 0))
        select_next_fixed_set(state);
    if (ImGui::MenuItem("New fixed set", "Shift+N")) begin_fixed_set(state);
    ImGui::Separator();
    if (ImGui::MenuItem(("Rename " + quoted + "###rename").c_str(), "F2", false, !name.empty()))
        panels_.selection.rename(state);
    if (ImGui::MenuItem(("Remove " + quoted + "###remove").c_str(), "Del", false, !name.empty()))
        remove_selection(state);
    if (ImGui::MenuItem("Remove all handles", "Shift+Del", false, scene.n_handles() > 0)) state.clear_handles();
    ImGui::EndMenu();
}

void MenuPanel::draw(const PanelContext& context) {
    ViewerState& state = context.state;
    if (!ImGui::BeginMainMenuBar()) return;
    draw_file(state, context.gui.scale());
    draw_edit(state);
    draw_view(state);
    if (ImGui::BeginMenu("Help")) {
        if (ImGui::MenuItem("Mouse and keys", "?")) state.show_help = true;
        ImGui::EndMenu();
    }
    ImGui::EndMainMenuBar();
}

}  // namespace elastolab
