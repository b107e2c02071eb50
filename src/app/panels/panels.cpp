#include "app/panels/panels.hpp"

#include <imgui.h>

#include <array>
#include <utility>
#include <vector>

#include "app/panels/display_panel.hpp"
#include "app/panels/help_panel.hpp"
#include "app/panels/overlays_panel.hpp"
#include "app/panels/status_panel.hpp"
#include "app/panels/widgets.hpp"

namespace elastolab {

namespace {

constexpr const char* kPullTitle = "Pull";  ///< of the section that is opened for a name

}  // namespace

void Panels::draw(const PanelContext& context) {
    costs_.measure_program();
    menu_.draw(context);
    if (!context.state.blank()) draw_side(context);
    draw_status(context);
    draw_overlays(context);
    if (context.state.show_help) draw_help(context);
    if (std::exchange(context.state.files.wants_name, false)) files_.ask_name_of_unsaved(context.state);
    picture_.draw(context, files_);
    files_.draw(context.gui.scale());
    selection_.draw_name_alone(context);
    recovery_.draw(context);
    unsaved_.draw(context, files_.asking());
}

void Panels::visit_user_texts(const ViewerState& state, const std::function<void(std::string_view)>& visit) const {
    const LiveScene& scene = state.scene();
    visit(scene.name());
    visit(scene.file().string());
    for (int handle = 0; handle < scene.n_handles(); ++handle) visit(scene.handle_name(handle));
    for (int set = 0; set < scene.n_fixed_sets(); ++set) visit(scene.fixed_name(set));
    for (int load = 0; load < scene.n_loads(); ++load) visit(scene.load_name(load));
    for (const Messages::Message& message : state.messages.all()) visit(message.text);
    for (const std::filesystem::path& file : state.files.recent()) visit(file.string());
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
    const std::array<Section, 8> sections = {
        {{"Method", [&] { method_.draw(context); }, true},
         {kPullTitle,
          [&] {
              pull_.draw(context, side_room_);
              selection_.draw(context);
          },
          true},
         {"Loads", [&] { loads_.draw(context); }, has_loads},
         {"Show", [&] { draw_display(context); }, tall},
         {"Body", [&] { body_.draw(context, [&] { files_.ask_open(context.state); }); }, tall},
         {"Compare", [&] { compare_.draw(context); }, tall},
         {"Probes", [&] { probes_.draw(context); }, false},
         {"Performance", [&] { performance_.draw(context); }, false}}};
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
    if (selection_.asks_name() && section.title == kPullTitle) ImGui::SetNextItemOpen(true);
    const bool open = ImGui::CollapsingHeader(section.title);
    ImGui::PopFont();
    if (!open) return;
    ImGui::PushID(section.title);
    section.draw();
    ImGui::PopID();
    ImGui::Dummy({0.0f, 4.0f * context.gui.scale()});
}

/// Buttons in place of headings, for one section at a time.
void Panels::draw_tabs(const PanelContext& context, std::span<const Section> sections) {
    std::vector<Segment> tabs;
    for (const Section& section : sections) tabs.push_back({section.title, ""});
    for (std::size_t i = 0; i < sections.size(); ++i)
        if (selection_.asks_name() && sections[i].title == kPullTitle) tab_ = i;
    const Palette& palette = context.palette;
    ImGui::PushFont(context.gui.fonts().bold);
    ImGui::PushStyleColor(ImGuiCol_Button, ImVec4());
    const auto chosen = draw_segments({palette.border, palette.text}, tabs, tab_);
    ImGui::PopStyleColor();
    ImGui::PopFont();
    if (chosen) tab_ = *chosen;
    ImGui::Separator();
    ImGui::PushID(sections[tab_].title);
    sections[tab_].draw();
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
