#pragma once

#include "base/control.hpp"

namespace elastolab {

/// While it lives, Ctrl-C (SIGINT) and SIGTERM cancel `control` instead of ending the program; a second one ends it.
/// At most one at a time.
class InterruptGuard {
public:
    explicit InterruptGuard(Control& control);
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;
};

/// The exit code that shells expect after the signal that came: 128 plus its number, 130 for Ctrl-C.
int interrupt_exit_code();

}  // namespace elastolab
