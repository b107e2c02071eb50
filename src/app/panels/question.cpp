#include "app/panels/question.hpp"

#include <imgui.h>

#include "app/panels/widgets.hpp"

namespace elastolab {

namespace {

bool pressed(ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), false); }

int moved(int choice, int n) {
    const bool back = pressed(ImGuiKey_LeftArrow) || (pressed(ImGuiKey_Tab) && ImGui::GetIO().KeyShift);
    const bool on = pressed(ImGuiKey_RightArrow) || (pressed(ImGuiKey_Tab) && !ImGui::GetIO().KeyShift);
    return (choice + (on ? 1 : 0) + (back ? n - 1 : 0)) % n;
}

}  // namespace

std::optional<int> draw_answers(const PanelContext& context, std::span<const QuestionAnswer> answers, int& choice,
                                int escape) {
    const auto n = static_cast<int>(answers.size());
    if (!ImGui::IsWindowAppearing()) choice = moved(choice, n);
    std::optional<int> answer;
    for (int i = 0; i < n; ++i) {
        const auto& [label, explanation] = answers[static_cast<std::size_t>(i)];
        if (i > 0) ImGui::SameLine();
        const bool stands_out = i == choice;
        if (stands_out) {
            ImGui::PushStyleColor(ImGuiCol_Button, imgui_colour(context.palette.accent));
            ImGui::PushStyleColor(ImGuiCol_Text, imgui_colour(context.palette.panel));
        }
        if (ImGui::Button(label, {112.0f * context.gui.scale(), 0.0f})) answer = i;
        if (stands_out) ImGui::PopStyleColor(2);
        tooltip(explanation);
    }
    if (ImGui::IsWindowAppearing()) return answer;  // the key that brought the question does not answer it
    if (pressed(ImGuiKey_Enter) || pressed(ImGuiKey_KeyPadEnter) || pressed(ImGuiKey_Space)) answer = choice;
    if (pressed(ImGuiKey_Escape)) answer = escape;
    return answer;
}

bool begin_question(const char* title) {
    if (!ImGui::IsPopupOpen(title)) ImGui::OpenPopup(title);
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * screen.x, 0.5f * screen.y}, ImGuiCond_Always, {0.5f, 0.5f});
    return ImGui::BeginPopupModal(title, nullptr,
                                  ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav);
}

}  // namespace elastolab
