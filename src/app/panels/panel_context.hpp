#pragma once

#include "app/panels/gui.hpp"
#include "app/panels/layout.hpp"
#include "app/picture/palette.hpp"
#include "app/viewer_state.hpp"

namespace elastolab {

/// What the panels need to be drawn.
struct PanelContext {
    ViewerState& state;
    const Gui& gui;
    const Layout& layout;
    const Palette& palette;
};

}  // namespace elastolab
