#pragma once

namespace elastolab {

struct PanelContext;

/// What is shown and how: the field and its colours, the material, the section, the names of units. It keeps nothing:
/// all is in the state's DisplaySettings.
void draw_display(const PanelContext& context);

}  // namespace elastolab
