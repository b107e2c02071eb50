#include <imgui.h>

#include <array>
#include <filesystem>
#include <optional>

#include "app/panels/panel_context.hpp"
#include "app/panels/question.hpp"

namespace elastolab {

namespace {

constexpr const char* kTitle = "Unsaved changes";

/// In the order of UnsavedAnswer.
constexpr std::array<QuestionAnswer, 3> kUnsavedAnswers = {{{"Save", "Enter: writes the scene, then goes on."},
                                                            {"Discard", "Goes on without the changes."},
                                                            {"Cancel", "Esc: everything stays as it is."}}};

}  // namespace

void UnsavedQuestion::draw(const PanelContext& context, bool naming) {
    ViewerState& state = context.state;
    const bool asks = state.files.unsaved.asking() && !naming;
    if (!asks && !ImGui::IsPopupOpen(kTitle)) return;
    if (!ImGui::IsPopupOpen(kTitle)) choice_ = 0;
    if (!begin_question(kTitle)) return;
    const std::filesystem::path& file = state.files.file();
    ImGui::Text("%s has changes that are not saved.",
                (file.empty() ? std::filesystem::path(state.scene().name()) : file).filename().c_str());
    ImGui::Spacing();
    const std::optional<int> answer =
        draw_answers(context, kUnsavedAnswers, choice_, static_cast<int>(UnsavedAnswer::cancel));
    if (answer || !asks) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    if (answer && asks) state.files.answer(static_cast<UnsavedAnswer>(*answer));
}

}  // namespace elastolab
