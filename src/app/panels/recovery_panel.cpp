#include <imgui.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "app/panels/panel_context.hpp"
#include "app/panels/question.hpp"
#include "base/text.hpp"

namespace elastolab {

namespace {

constexpr const char* kRecoveryTitle = "Recover a scene";

enum Recovery { recover, discard, later };
constexpr std::array<QuestionAnswer, 3> kRecoveryAnswers = {
    {{"Recover", "Enter: opens the scene as it was, unsaved."},
     {"Discard", "Deletes the copy."},
     {"Later", "Esc: asks again when the viewer is started the next time."}}};

double seconds_since(std::filesystem::file_time_type time) {
    return std::chrono::duration<double>(std::filesystem::file_time_type::clock::now() - time).count();
}

}  // namespace

/// What a viewer that was killed has left.
void RecoveryQuestion::draw(const PanelContext& context) {
    SceneFiles& files = context.state.files;
    if (files.recoverable.empty() || files.loading() || files.unsaved.asking()) return;
    if (!ImGui::IsPopupOpen(kRecoveryTitle)) choice_ = 0;
    if (!begin_question(kRecoveryTitle)) return;
    const AutosavedScene& left = files.recoverable.front();
    const std::string of_body = left.body.empty() ? "" : " (" + left.body + ")";
    const std::string name = (left.origin.empty() ? "a scene that was not saved yet" : left.origin.string()) + of_body;
    ImGui::TextUnformatted("A viewer ended unexpectedly, with unsaved changes of");
    ImGui::TextUnformatted(name.c_str());
    ImGui::Text("Kept %s ago.", readable_seconds(std::max(0.0, seconds_since(left.time))).c_str());
    ImGui::Spacing();
    const std::optional<int> answer = draw_answers(context, kRecoveryAnswers, choice_, later);
    if (answer) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    if (answer == recover) files.recover();
    if (answer == discard) files.discard_recoverable();
    if (answer == later) files.recoverable.clear();
}

}  // namespace elastolab
