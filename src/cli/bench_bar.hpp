#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "study/report/progress.hpp"

namespace elastolab {

/// While it lives, shows how far a study has come, and the time left, on standard error if that is a terminal. Clears
/// its line at the end.
class BenchBar {
public:
    BenchBar(const StudyProgress& progress, bool wanted);

private:
    void show(const std::stop_token& stop);

    const StudyProgress& progress_;
    std::mutex mutex_;
    std::condition_variable_any wake_;
    std::jthread thread_;  ///< last, so that it is joined first
};

}  // namespace elastolab
