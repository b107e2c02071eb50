#pragma once

namespace elastolab {

struct PanelContext;

/// The line at the bottom: what is under the cursor or under way, else the scene; and how long frames take.
void draw_status(const PanelContext& context);

}  // namespace elastolab
