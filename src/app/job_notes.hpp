#pragma once

#include <exception>
#include <string>

#include "app/messages.hpp"
#include "scene/live/background_job.hpp"
#include "scene/user_text.hpp"

namespace elastolab {

/// Shows the note that a job ended with, or why it failed; true when there is something new to see. Once per frame.
bool tell_end(BackgroundJob<std::string>& job, Messages& messages);

/// False when the action failed, which becomes a message.
template <class Action>
bool attempt(Messages& messages, const Action& action) {
    try {
        action();
        return true;
    } catch (const std::exception& error) {
        messages.error(user_text(error));
        return false;
    }
}

}  // namespace elastolab
