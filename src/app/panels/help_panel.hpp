#pragma once

namespace elastolab {

struct PanelContext;

/// The window with all gestures of the mouse and all keys.
void draw_help(const PanelContext& context);

}  // namespace elastolab
