#pragma once

#include <optional>
#include <string>
#include <utility>

#include "app/panels/widgets.hpp"

namespace elastolab {

struct PanelContext;
class ViewerState;

/// Gravity and loads of the scene: a list of them, their names and sizes as numbers that can be typed, and the tools
/// that make more with the mouse.
class LoadsPanel {
public:
    void draw(const PanelContext& context);

private:
    void draw_tools(const PanelContext& context);
    void draw_gravity(const PanelContext& context);
    void draw_list(const PanelContext& context);
    void draw_selected(const PanelContext& context);
    void draw_name(ViewerState& state, int load, float scale);

    NumberField density_;
    std::optional<std::pair<int, std::string>> typed_name_;  ///< of a load, while it is typed
};

}  // namespace elastolab
