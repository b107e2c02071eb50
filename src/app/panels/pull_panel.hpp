#pragma once

#include <optional>
#include <string>
#include <utility>

#include "app/selection.hpp"
#include "app/viewer_state.hpp"

namespace elastolab {

struct PanelContext;

/// The tools, what is fixed and what is pulled, and the selected one of these with its name and placement.
class PullPanel {
public:
    /// room: below the side panel's content in the last frame; negative: what did not fit.
    void draw(const PanelContext& context, float room);
    /// Opens the panel at the name of the selected handle or fixed set, so that another one can be typed; it is typed
    /// into once it is drawn.
    void rename_selection(ViewerState& state);
    bool asks_name() const { return asks_name_; }
    /// That field over the scene, where the window has no room for the panel.
    void draw_name_alone(const PanelContext& context);

private:
    void draw_tool_settings(const PanelContext& context);
    void draw_held(const PanelContext& context);
    float held_height(const PanelContext& context);
    void draw_fixed_sets(const PanelContext& context);
    void draw_handles(const PanelContext& context);
    void scroll_to(const ViewerState& state, const Selection& row) const;
    void draw_selection(const PanelContext& context);
    bool draw_name(const PanelContext& context);

    std::optional<std::pair<Selection, std::string>> typed_name_;  ///< while it is typed
    bool asks_name_ = false;
    std::optional<Selection> listed_;    ///< as the list was last scrolled to it
    float tool_settings_height_ = 0.0f;  ///< of those for pulling
    float held_height_ = 0.0f;           ///< of the list of handles; 0: not drawn yet
    float room_ = 0.0f;
};

}  // namespace elastolab
