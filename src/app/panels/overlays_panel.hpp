#pragma once

namespace elastolab {

struct PanelContext;

/// What is written over the scene: titles of the viewports, the legend, marks at the body, hints and messages.
void draw_overlays(const PanelContext& context);

}  // namespace elastolab
