#pragma once

#include <memory>

#include "app/input/interaction_log.hpp"
#include "app/window/timings.hpp"

namespace elastolab {

/// What the viewer measures and records about itself.
struct Measurements {
    FrameHistory history;
    FrameTimes last_frame;
    int frame = 0;  ///< number of the present one
    std::unique_ptr<TimingsRecorder> timings;
    std::unique_ptr<InteractionRecorder> recorder;
};

}  // namespace elastolab
