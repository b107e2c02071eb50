#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "base/control.hpp"

namespace elastolab {

/// While it lives, shows stage and progress of `control` on standard error: only on a terminal, only once a second has
/// passed. Clears its line at the end.
class ProgressBar {
public:
    ProgressBar(const Control& control, bool wanted);

private:
    void show(const std::stop_token& stop);

    const Control& control_;
    std::mutex mutex_;
    std::condition_variable_any wake_;
    std::jthread thread_;  ///< last, so that it is joined first
};

}  // namespace elastolab
