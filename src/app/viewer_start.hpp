#pragma once

#include "app/viewer.hpp"
#include "app/viewer_state.hpp"
#include "base/control.hpp"

namespace elastolab {

/// Whether no person sees the window or has the time to look at it.
bool nobody_watches(const ViewerOptions& options);

/// What needs no window: the body, the method and what is shown of it as the options ask, and the beginning of the
/// precomputation, which goes on while the window is being made. Where somebody will see the window, a file that cannot
/// be opened is reported there. Throws as run_viewer() does.
void begin_viewer(ViewerState& state, const ViewerOptions& options, Control& control);

}  // namespace elastolab
