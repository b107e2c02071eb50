#include "cli/interrupt.hpp"

#include <atomic>
#include <cassert>
#include <csignal>

namespace elastolab {

namespace {

std::atomic<Control*> watched{nullptr};
std::atomic<int> last_signal{SIGINT};
static_assert(std::atomic<Control*>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

void on_signal(int signal) {
    last_signal = signal;
    if (Control* control = watched) control->cancel();
    std::signal(signal, SIG_DFL);
}

}  // namespace

InterruptGuard::InterruptGuard(Control& control) {
    assert(watched == nullptr);
    watched = &control;
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
}

InterruptGuard::~InterruptGuard() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    watched = nullptr;
}

int interrupt_exit_code() { return 128 + last_signal; }

}  // namespace elastolab
