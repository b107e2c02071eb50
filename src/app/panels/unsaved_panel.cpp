#include <imgui.h>

#include <array>
#include <filesystem>
#include <optional>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"

namespace elastolab {

namespace {

constexpr const char* kTitle = "Unsaved changes";

constexpr std::array<Choice<UnsavedAnswer>, 3> kAnswers = {
    {{UnsavedAnswer::save, "Save", "Enter: writes the scene, then goes on."},
     {UnsavedAnswer::discard, "Discard", "Goes on without the changes."},
     {UnsavedAnswer::cancel, "Cancel", "Esc: everything stays as it is."}}};

bool pressed(ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), false); }

/// Left, right and Tab go from answer to answer.
int moved(int choice) {
    const auto n = static_cast<int>(kAnswers.size());
    const bool back = pressed(ImGuiKey_LeftArrow) || (pressed(ImGuiKey_Tab) && ImGui::GetIO().KeyShift);
    const bool on = pressed(ImGuiKey_RightArrow) || (pressed(ImGuiKey_Tab) && !ImGui::GetIO().KeyShift);
    return (choice + (on ? 1 : 0) + (back ? n - 1 : 0)) % n;
}

/// The buttons, that of `choice` standing out. The answer, when one was given by mouse or keys.
std::optional<UnsavedAnswer> draw_answers(const PanelContext& context, int choice) {
    std::optional<UnsavedAnswer> answer;
    for (int i = 0; i < static_cast<int>(kAnswers.size()); ++i) {
        const auto& [value, label, explanation] = kAnswers[static_cast<std::size_t>(i)];
        if (i > 0) ImGui::SameLine();
        if (i == choice) ImGui::PushStyleColor(ImGuiCol_Button, imgui_colour(context.palette.accent));
        if (ImGui::Button(label, {112.0f * context.gui.scale(), 0.0f})) answer = value;
        if (i == choice) ImGui::PopStyleColor();
        tooltip(explanation);
    }
    if (ImGui::IsWindowAppearing()) return answer;  // the key that brought the question does not answer it
    if (pressed(ImGuiKey_Enter) || pressed(ImGuiKey_KeyPadEnter) || pressed(ImGuiKey_Space))
        answer = kAnswers[static_cast<std::size_t>(choice)].value;
    if (pressed(ImGuiKey_Escape)) answer = UnsavedAnswer::cancel;
    return answer;
}

}  // namespace

/// The question before changes are lost. It waits behind the dialog that asks for the scene's name.
void Panels::draw_unsaved(const PanelContext& context) {
    ViewerState& state = context.state;
    const bool asks = state.unsaved.asking() && !files_.is_open();
    if (asks && !ImGui::IsPopupOpen(kTitle)) {
        ImGui::OpenPopup(kTitle);
        unsaved_choice_ = 0;
    }
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * screen.x, 0.5f * screen.y}, ImGuiCond_Always, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal(kTitle, nullptr,
                                ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav))
        return;
    const std::filesystem::path& file = state.scene_file();
    ImGui::Text("%s has changes that are not saved.",
                (file.empty() ? std::filesystem::path(state.scene().name()) : file).filename().c_str());
    ImGui::Spacing();
    if (!ImGui::IsWindowAppearing()) unsaved_choice_ = moved(unsaved_choice_);
    const std::optional<UnsavedAnswer> answer = draw_answers(context, unsaved_choice_);
    if (answer || !asks) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    if (answer && asks) state.answer_unsaved(*answer);
}

}  // namespace elastolab
