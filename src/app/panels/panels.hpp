#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string_view>

#include "app/panels/body_panel.hpp"
#include "app/panels/compare_panel.hpp"
#include "app/panels/cost_predictions.hpp"
#include "app/panels/file_questions.hpp"
#include "app/panels/loads_panel.hpp"
#include "app/panels/menu_panel.hpp"
#include "app/panels/method_panel.hpp"
#include "app/panels/panel_context.hpp"
#include "app/panels/performance_panel.hpp"
#include "app/panels/picture_panel.hpp"
#include "app/panels/probe_panel.hpp"
#include "app/panels/pull_panel.hpp"
#include "app/panels/question.hpp"
#include "app/panels/selection_panel.hpp"
#include "app/panels/warnings_panel.hpp"

namespace elastolab {

/// The menu, the side panel, the status line and what is written over the scene, each a class or function of its own
/// that is laid out here. No numerics: it reads the state, and every change goes through it.
class Panels {
public:
    Panels() = default;
    Panels(const Panels&) = delete;  // its panels refer to one another
    Panels& operator=(const Panels&) = delete;

    void draw(const PanelContext& context);

    /// Every text from the user that may be shown: names of bodies, handles and files, messages.
    void visit_user_texts(const ViewerState& state, const std::function<void(std::string_view)>& visit) const;

    // What keys begin.
    FileQuestions& files() { return files_; }
    SelectionPanel& selection() { return selection_; }

private:
    /// A part of the side panel.
    struct Section {
        const char* title;
        std::function<void()> draw;
        bool open;  ///< at first
    };
    void draw_side(const PanelContext& context);
    void draw_sections(const PanelContext& context);
    void draw_folding(const PanelContext& context, const Section& section);
    void draw_tabs(const PanelContext& context, std::span<const Section> sections);
    void draw_splitter(const PanelContext& context);

    FileQuestions files_;
    CostPredictions costs_;
    MethodPanel method_{costs_};
    PullPanel pull_;
    SelectionPanel selection_;
    LoadsPanel loads_;
    BodyPanel body_;
    ComparePanel compare_{costs_};
    ProbePanel probes_{files_};
    PerformancePanel performance_{files_};
    WarningsPanel warnings_;
    PicturePanel picture_;
    MenuPanel menu_{{files_, body_, picture_, selection_}};
    RecoveryQuestion recovery_;
    UnsavedQuestion unsaved_;
    std::size_t tab_ = 0;     ///< of the sections of a short panel
    float side_room_ = 0.0f;  ///< below the side panel's content in the last frame; negative: what did not fit
    bool side_fits_ = true;   ///< the side panel's content did, in the last frame
};

}  // namespace elastolab
