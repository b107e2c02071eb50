#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/panels/body_panel.hpp"
#include "app/panels/cost_predictions.hpp"
#include "app/panels/examples_panel.hpp"
#include "app/panels/gui.hpp"
#include "app/panels/layout.hpp"
#include "app/panels/loads_panel.hpp"
#include "app/panels/method_panel.hpp"
#include "app/panels/picture_panel.hpp"
#include "app/panels/pull_panel.hpp"
#include "app/panels/question.hpp"
#include "app/panels/warnings_panel.hpp"
#include "app/picture/palette.hpp"
#include "app/viewer_state.hpp"
#include "app/window/file_dialog.hpp"

namespace elastolab {

/// What the panels need to be drawn.
struct PanelContext {
    ViewerState& state;
    const Gui& gui;
    const Layout& layout;
    const Palette& palette;
};

/// A name for an output of this scene, by the name of its mesh.
std::string suggested_name(const ViewerState& state, const std::string& ending);

/// The menu, the side panel, the status line and what is written over the scene. No numerics: it reads the state, and
/// every change goes through it.
class Panels {
public:
    void draw(const PanelContext& context);

    /// Every text from the user that may be shown: names of bodies, handles and files, messages.
    void visit_user_texts(const ViewerState& state, const std::function<void(std::string_view)>& visit) const;

    void ask_open(ViewerState& state);
    /// Overwrites the scene's own file if this session wrote it already, else as save_as().
    void save(ViewerState& state);
    void save_as(ViewerState& state);
    void ask_export(ViewerState& state, const std::string& ending);
    void ask_screenshot(ViewerState& state);
    void ask_probes(ViewerState& state);
    void ask_timings(ViewerState& state);
    /// Opens the panel at the name of the selected handle or fixed set, so that another one can be typed.
    void rename_selection(ViewerState& state);

private:
    /// A part of the side panel.
    struct Section {
        const char* title;
        void (Panels::*draw)(const PanelContext&);
        bool open;  ///< at first
    };
    // One file each: menu_panel.cpp, method_panel.cpp, ...
    void draw_menu(const PanelContext& context);
    void draw_side(const PanelContext& context);
    void draw_sections(const PanelContext& context);
    void draw_folding(const PanelContext& context, const Section& section);
    void draw_tabs(const PanelContext& context, std::span<const Section> sections);
    void draw_splitter(const PanelContext& context);
    void draw_method(const PanelContext& context) { method_.draw(context); }
    void draw_body(const PanelContext& context) {
        body_.draw(context, [&] { ask_open(context.state); });
    }
    void draw_pull(const PanelContext& context) { pull_.draw(context, side_room_); }
    void draw_loads(const PanelContext& context) { loads_.draw(context); }
    void draw_edit(ViewerState& state);
    void draw_probes(const PanelContext& context);
    void draw_compare(const PanelContext& context);
    void draw_display(const PanelContext& context);
    void draw_performance(const PanelContext& context);
    void draw_status(const PanelContext& context);
    void draw_overlays(const PanelContext& context);
    void draw_help(const PanelContext& context);
    void draw_export_menu(ViewerState& state);
    void ask_name_of_unsaved(ViewerState& state);

    FileDialog files_;
    CostPredictions costs_;
    MethodPanel method_{costs_};
    PullPanel pull_;
    LoadsPanel loads_;
    BodyPanel body_;
    ExamplesPanel examples_;
    WarningsPanel warnings_;
    PicturePanel picture_;
    RecoveryQuestion recovery_;
    UnsavedQuestion unsaved_;
    std::size_t tab_ = 0;     ///< of the sections of a short panel
    float side_room_ = 0.0f;  ///< below the side panel's content in the last frame; negative: what did not fit
    bool side_fits_ = true;   ///< the side panel's content did, in the last frame
};

}  // namespace elastolab
