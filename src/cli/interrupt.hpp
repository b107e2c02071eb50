#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <thread>

#include "base/control.hpp"

namespace elastolab {

/// Time that a computation has to return after it was cancelled [s]. Libraries may not return for minutes.
constexpr double kInterruptGraceSeconds = 1.0;

/// While it lives, Ctrl-C (SIGINT) and SIGTERM cancel `control` instead of ending the program. If the guard still lives
/// after the grace, the program is ended from here: helper programs are killed, temporary files removed, `last_words`
/// printed as a complaint unless they are empty, and the exit code is interrupt_exit_code(). A second signal ends the
/// program at once. `wake`, if given, is called on another thread after the cancel: for a computation that sleeps. At
/// most one guard at a time.
class InterruptGuard {
public:
    explicit InterruptGuard(Control& control, std::string last_words = "Interrupted; no output was written.",
                            std::function<void()> wake = {}, double grace_seconds = kInterruptGraceSeconds);
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

private:
    void watch();

    std::string last_words_;
    std::function<void()> wake_;
    double grace_seconds_;
    std::atomic<bool> over_{false};
    std::thread watcher_;
};

/// The exit code that shells expect after the signal that came: 128 plus its number, 130 for Ctrl-C.
int interrupt_exit_code();

}  // namespace elastolab
