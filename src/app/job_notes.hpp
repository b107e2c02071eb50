#pragma once

#include <string>

#include "app/messages.hpp"
#include "scene/live/background_job.hpp"

namespace elastolab {

/// Shows the note that a job ended with, or why it failed; true when there is something new to see. Once per frame.
bool tell_end(BackgroundJob<std::string>& job, Messages& messages);

}  // namespace elastolab
