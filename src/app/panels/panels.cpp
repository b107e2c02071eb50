#include "app/panels/panels.hpp"

#include <imgui.h>

#include <array>

#include "app/panels/widgets.hpp"

namespace elastolab {

namespace {

const std::vector<std::string> kMeshFiles = {".obj", ".ply", ".stl", ".off", ".gltf", ".glb"};

std::vector<std::string> with_scenes(std::vector<std::string> extensions) {
    extensions.insert(extensions.begin(), ".json");
    return extensions;
}

}  // namespace

std::string suggested_name(const ViewerState& state, const std::string& ending) {
    return std::filesystem::path(state.scene().name()).stem().string() + ending;
}

void Panels::ask_open(ViewerState& state) {
    files_.open({"Open a mesh or scene", with_scenes(kMeshFiles), "", [&](const auto& file) { state.open(file); }});
}

void Panels::save(ViewerState& state) {
    if (state.owns_scene_file())
        state.save_scene(std::filesystem::path(state.scene_file()));
    else
        save_as(state);
}

void Panels::save_as(ViewerState& state) {
    const std::filesystem::path& present = state.scene_file();
    files_.open({.title = "Save the scene",
                 .extensions = {".json"},
                 .suggestion = present.empty() ? suggested_name(state, ".json") : present.filename().string(),
                 .done = [&](const auto& file) { state.save_scene(file); },
                 .folder = present.parent_path()});
}

/// Asks for the name of a scene that is to be saved before it is replaced; without a name it stays.
void Panels::ask_name_of_unsaved(ViewerState& state) {
    files_.open({.title = "Save the scene",
                 .extensions = {".json"},
                 .suggestion = suggested_name(state, ".json"),
                 .done =
                     [&](const auto& file) {
                         if (state.save_scene(file)) state.unsaved.proceed();
                     },
                 .cancelled = [&] { state.unsaved.cancel(); }});
}

void Panels::rename_selection(ViewerState& state) {
    if (!state.selection()) return;
    state.display.panel = true;
    pull_.ask_name();
}

void Panels::ask_screenshot(ViewerState& state) {
    files_.open({"Save a screenshot", {".png"}, suggested_name(state, ".png"), [&](const auto& file) {
                     state.requests.screenshot = file;
                 }});
}

void Panels::ask_probes(ViewerState& state) {
    files_.open({"Save the probes", {".csv"}, suggested_name(state, "-probes.csv"), [&](const auto& file) {
                     state.save_probes(file);
                 }});
}

void Panels::ask_timings(ViewerState& state) {
    files_.open({"Record frame timings", {".csv"}, suggested_name(state, "-timings.csv"), [&](const auto& file) {
                     state.record_timings(file);
                 }});
}

void Panels::draw(const PanelContext& context) {
    costs_.measure_program();
    draw_menu(context);
    if (!context.state.blank()) draw_side(context);
    draw_status(context);
    draw_overlays(context);
    if (context.state.show_help) draw_help(context);
    if (std::exchange(context.state.requests.scene_name, false)) ask_name_of_unsaved(context.state);
    picture_.draw(context, files_);
    files_.draw(context.gui.scale());
    pull_.draw_name_alone(context);
    recovery_.draw(context);
    unsaved_.draw(context, files_.is_open());
}

void Panels::visit_user_texts(const ViewerState& state, const std::function<void(std::string_view)>& visit) const {
    const LiveScene& scene = state.scene();
    visit(scene.name());
    visit(scene.file().string());
    for (int handle = 0; handle < scene.n_handles(); ++handle) visit(scene.handle_name(handle));
    for (int set = 0; set < scene.n_fixed_sets(); ++set) visit(scene.fixed_name(set));
    for (int load = 0; load < scene.n_loads(); ++load) visit(scene.load_name(load));
    for (const Messages::Message& message : state.messages.all()) visit(message.text);
    for (const std::filesystem::path& file : state.recent_files()) visit(file.string());
    files_.visit_texts(visit);
}

void Panels::draw_side(const PanelContext& context) {
    const Viewport& place = context.layout.panel;
    if (place.width <= 0.0) return;
    const float warnings = warnings_.draw(context);
    ImGui::SetNextWindowPos({static_cast<float>(place.x), static_cast<float>(place.y)});
    ImGui::SetNextWindowSize({static_cast<float>(place.width), static_cast<float>(place.height) - warnings});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
    // Its place is kept, so that nothing moves when it is needed; until then nothing of it is seen.
    ImGui::PushStyleColor(ImGuiCol_ScrollbarGrab,
                          side_fits_ ? ImVec4() : ImGui::GetStyleColorVec4(ImGuiCol_ScrollbarGrab));
    ImGui::Begin("##side", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBringToFrontOnFocus |
                     ImGuiWindowFlags_AlwaysVerticalScrollbar);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
    side_fits_ = ImGui::GetScrollMaxY() <= 0.0f;
    draw_sections(context);
    side_room_ = ImGui::GetContentRegionAvail().y + ImGui::GetScrollY() - ImGui::GetScrollMaxY();
    ImGui::End();
    draw_splitter(context);
}

/// Those used most come first, and the others are open where there is room. Where there is little, the method comes
/// first and the others share what is left, so that each is one click away.
void Panels::draw_sections(const PanelContext& context) {
    const bool tall = context.layout.panel.height >= kTallPanel * context.gui.scale();
    const bool has_loads = !context.state.scene().constraints().loads.empty();
    const std::array<Section, 8> sections = {{{"Method", &Panels::draw_method, true},
                                              {"Pull", &Panels::draw_pull, true},
                                              {"Loads", &Panels::draw_loads, has_loads},
                                              {"Show", &Panels::draw_display, tall},
                                              {"Body", &Panels::draw_body, tall},
                                              {"Compare", &Panels::draw_compare, tall},
                                              {"Probes", &Panels::draw_probes, false},
                                              {"Performance", &Panels::draw_performance, false}}};
    if (is_short(context.layout, context.gui.scale())) {
        draw_folding(context, sections.front());
        draw_tabs(context, std::span(sections).subspan(1));
    } else {
        for (const Section& section : sections) draw_folding(context, section);
    }
}

void Panels::draw_folding(const PanelContext& context, const Section& section) {
    ImGui::PushFont(context.gui.fonts().bold);
    ImGui::SetNextItemOpen(section.open, ImGuiCond_Once);
    if (pull_.asks_name() && section.draw == &Panels::draw_pull) ImGui::SetNextItemOpen(true);
    const bool open = ImGui::CollapsingHeader(section.title);
    ImGui::PopFont();
    if (!open) return;
    ImGui::PushID(section.title);
    (this->*section.draw)(context);
    ImGui::PopID();
    ImGui::Dummy({0.0f, 4.0f * context.gui.scale()});
}

/// Buttons in place of headings, for one section at a time.
void Panels::draw_tabs(const PanelContext& context, std::span<const Section> sections) {
    std::vector<Segment> tabs;
    for (const Section& section : sections) tabs.push_back({section.title, ""});
    for (std::size_t i = 0; i < sections.size(); ++i)
        if (pull_.asks_name() && sections[i].draw == &Panels::draw_pull) tab_ = i;
    const Palette& palette = context.palette;
    ImGui::PushFont(context.gui.fonts().bold);
    ImGui::PushStyleColor(ImGuiCol_Button, ImVec4());
    const auto chosen = draw_segments({palette.border, palette.text}, tabs, tab_);
    ImGui::PopStyleColor();
    ImGui::PopFont();
    if (chosen) tab_ = *chosen;
    ImGui::Separator();
    ImGui::PushID(sections[tab_].title);
    (this->*sections[tab_].draw)(context);
    ImGui::PopID();
}

/// The panel's edge, which can be moved.
void Panels::draw_splitter(const PanelContext& context) {
    const Viewport& place = context.layout.panel;
    const float scale = context.gui.scale(), half = 3.0f * scale;
    ImGui::SetNextWindowPos({static_cast<float>(place.width) - half, static_cast<float>(place.y)});
    ImGui::SetNextWindowSize({2.0f * half, static_cast<float>(place.height)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0f, 1.0f});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0f, 0.0f});
    ImGui::Begin("##splitter", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBackground |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::InvisibleButton("edge", {2.0f * half, static_cast<float>(place.height)});
    if (ImGui::IsItemActive()) context.state.display.panel_width = std::max(1.0f, ImGui::GetIO().MousePos.x / scale);
    if (ImGui::IsItemActive() || ImGui::IsItemHovered()) {
        const auto x = static_cast<float>(place.width);
        ImGui::GetForegroundDrawList()->AddLine({x, static_cast<float>(place.y)},
                                                {x, static_cast<float>(place.y + place.height)},
                                                imgui_packed(context.palette.accent), 2.0f * scale);
    }
    ImGui::End();
    ImGui::PopStyleVar(2);
}

}  // namespace elastolab
