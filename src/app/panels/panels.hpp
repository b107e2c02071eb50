#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "app/examples.hpp"
#include "app/panels/gui.hpp"
#include "app/panels/layout.hpp"
#include "app/panels/loads_panel.hpp"
#include "app/picture/palette.hpp"
#include "app/viewer_state.hpp"
#include "app/window/file_dialog.hpp"
#include "findings/cost.hpp"
#include "render/gl/picture_texture.hpp"

namespace elastolab {

/// What the panels need to be drawn.
struct PanelContext {
    ViewerState& state;
    const Gui& gui;
    const Layout& layout;
    const Palette& palette;
};

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
    void draw_method(const PanelContext& context);
    void draw_mode(const PanelContext& context);
    void draw_body(const PanelContext& context);
    void draw_pull(const PanelContext& context);
    void draw_loads(const PanelContext& context) { loads_.draw(context); }
    void draw_tool_settings(const PanelContext& context);
    void draw_fixed_sets(const PanelContext& context);
    void draw_handles(const PanelContext& context);
    float held_height(const PanelContext& context);
    void draw_held(const PanelContext& context);
    bool draw_name(const PanelContext& context);
    void draw_name_alone(const PanelContext& context);
    void draw_selection(const PanelContext& context);
    void draw_edit(ViewerState& state);
    void scroll_to(const ViewerState& state, const ViewerState::Selection& row) const;
    MethodKind sooner_method(const ViewerState& state);
    void draw_sooner(const PanelContext& context);
    void draw_probes(const PanelContext& context);
    void draw_compare(const PanelContext& context);
    void draw_display(const PanelContext& context);
    void draw_performance(const PanelContext& context);
    void draw_status(const PanelContext& context);
    void draw_overlays(const PanelContext& context);
    void draw_help(const PanelContext& context);
    void draw_examples(ViewerState& state, float scale);
    void load_examples();
    void draw_export_menu(ViewerState& state);
    void draw_picture(const PanelContext& context);
    void draw_picture_progress(const PanelContext& context);
    void draw_recovery(const PanelContext& context);
    void draw_unsaved(const PanelContext& context);
    void ask_name_of_unsaved(ViewerState& state);
    void draw_defects(const PanelContext& context);
    float draw_warnings(const PanelContext& context);
    void draw_proxy(ViewerState& state, float scale);
    void draw_young_modulus(ViewerState& state, float scale);
    void open_primitive(ViewerState& state);
    const Cost& cost(const ViewerState& state, const Method& method);
    std::uint64_t memory_with_completion(const ViewerState& state, MethodKind kind);
    std::uint64_t memory_of_comparison(const ViewerState& state);

    FileDialog files_;
    LoadsPanel loads_;
    struct ShownExample {
        Example example;
        std::unique_ptr<PictureTexture> picture;  ///< null when there is none
    };
    std::vector<ShownExample> examples_;
    bool examples_loaded_ = false;
    PictureRequest picture_;
    bool asks_picture_ = false;
    std::string video_obstacle_;  ///< why there can be no video
    int recovery_choice_ = 0;
    int unsaved_choice_ = 0;  ///< which button of the question Enter presses
    std::string primitive_ = "cube";
    int resolution_ = 13;
    std::optional<double> typed_modulus_;                                       ///< Young's modulus while it is typed
    std::optional<int> proxy_vertices_;                                         ///< while the slider is held
    std::optional<std::pair<ViewerState::Selection, std::string>> typed_name_;  ///< while it is typed
    bool asks_name_ = false;                        ///< the field for it is to be typed into
    std::optional<ViewerState::Selection> listed_;  ///< as the list was last scrolled to it
    std::size_t tab_ = 0;                           ///< of the sections of a short panel
    float tool_settings_height_ = 0.0f;             ///< of those for pulling
    float held_height_ = 0.0f;                      ///< of the list of handles; 0: not drawn yet
    float side_room_ = 0.0f;  ///< below the side panel's content in the last frame; negative: what did not fit
    bool side_fits_ = true;   ///< the side panel's content did, in the last frame
    std::uint64_t costs_of_scene_ = 0;
    struct Warning {
        std::string text;
        bool is_problem = false;      ///< there is no answer, or a part of it is missing
        MethodKind better = nullptr;  ///< that a button offers instead
    };
    static std::vector<Warning> present_warnings(const ViewerState& state);
    std::vector<Warning> warnings_;  ///< as they are shown, of this scene and method:
    std::pair<std::uint64_t, MethodKind> warnings_of_;
    std::set<std::string> unfolded_;  ///< warnings, without their numbers, that are shown with all their lines
    std::size_t n_flights_ = 0;       ///< to places of defects
    std::map<std::tuple<MethodKind, Mode, Update, int, int>, Cost>
        costs_;  ///< by vertices and triangles of what is simulated
    std::map<std::tuple<MethodKind, Mode, Update, int, int, int>, std::uint64_t> completed_bytes_;  ///< likewise
    std::uint64_t program_bytes_ = 0;  ///< of the program before it has computed anything
};

}  // namespace elastolab
