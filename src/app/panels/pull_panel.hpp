#pragma once

#include <optional>

#include "app/panels/widgets.hpp"
#include "app/selection.hpp"
#include "app/viewer_state.hpp"

namespace elastolab {

struct PanelContext;

/// The tools, and what is fixed and what is pulled.
class PullPanel {
public:
    /// room: below the side panel's content in the last frame; negative: what did not fit.
    void draw(const PanelContext& context, float room);

private:
    void draw_tool_settings(const PanelContext& context);
    void draw_held(const PanelContext& context);
    float held_height(const PanelContext& context);
    void draw_fixed_sets(const PanelContext& context);
    void draw_handles(const PanelContext& context);
    void scroll_to(const ViewerState& state, const Selection& row) const;

    NumberField spring_;
    std::optional<Selection> listed_;    ///< as the list was last scrolled to it
    float tool_settings_height_ = 0.0f;  ///< of those for pulling
    float held_height_ = 0.0f;           ///< of the list of handles; 0: not drawn yet
    float room_ = 0.0f;
};

}  // namespace elastolab
