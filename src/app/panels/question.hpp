#pragma once

#include <optional>
#include <span>

namespace elastolab {

struct PanelContext;

/// A button that answers a question.
struct QuestionAnswer {
    const char* label;
    const char* explanation;
};

/// The buttons in a row within a dialog, that of `choice` standing out. Left, right and Tab change the choice, Enter
/// and Space take it, Esc takes `escape`. Returns the number of the answer, when one was given.
std::optional<int> draw_answers(const PanelContext& context, std::span<const QuestionAnswer> answers, int& choice,
                                int escape);

/// Begins a dialog of this title in the middle of the window, opening it when it is not open. True when it is drawn:
/// then ImGui::EndPopup() must follow.
bool begin_question(const char* title);

/// What to do with the scene that a viewer which was killed has left.
class RecoveryQuestion {
public:
    void draw(const PanelContext& context);

private:
    int choice_ = 0;  ///< the button that Enter presses
};

/// The question before changes are lost.
class UnsavedQuestion {
public:
    /// naming: a dialog asks for the scene's name, which comes first.
    void draw(const PanelContext& context, bool naming);

private:
    int choice_ = 0;  ///< the button that Enter presses
};

}  // namespace elastolab
