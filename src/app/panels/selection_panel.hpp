#pragma once

#include <optional>
#include <string>
#include <utility>

#include "app/panels/widgets.hpp"
#include "app/selection.hpp"

namespace elastolab {

struct PanelContext;
class ViewerState;

/// The selected handle or fixed set: its name, and where a handle is put or what force moves it.
class SelectionPanel {
public:
    void draw(const PanelContext& context);
    /// Opens the panel at the name of the selected handle or fixed set, so that another one can be typed; it is typed
    /// into once it is drawn.
    void rename(ViewerState& state);
    bool asks_name() const { return asks_name_; }
    /// That field over the scene, where the window has no room for the panel.
    void draw_name_alone(const PanelContext& context);

private:
    bool draw_name(const PanelContext& context);
    void draw_placement(ViewerState& state, std::optional<int> handle, float scale);

    std::optional<std::pair<Selection, std::string>> typed_name_;  ///< while it is typed
    bool asks_name_ = false;
    NumberField scale_;
};

}  // namespace elastolab
