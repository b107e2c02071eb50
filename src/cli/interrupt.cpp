#include "cli/interrupt.hpp"

#include <semaphore.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <fstream>

#include "base/temporary_file.hpp"
#include "cli/complaint.hpp"

namespace elastolab {

namespace {

/// What ends a program that is waited for no longer: Ctrl-C, kill, a closed terminal.
constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};

std::atomic<Control*> watched{nullptr};
std::atomic<int> last_signal{SIGINT};
static_assert(std::atomic<Control*>::is_always_lock_free && std::atomic<int>::is_always_lock_free);
sem_t bell;  ///< posted by a signal, and when a guard goes; lives longer than any handler runs

/// Calls nothing but what a signal handler may call.
void on_signal(int signal) {
    const int error = errno;
    last_signal = signal;
    if (Control* control = watched) control->cancel();
    std::signal(signal, SIG_DFL);
    sem_post(&bell);
    errno = error;
}

void wait_for_bell() {
    while (sem_wait(&bell) != 0) {  // EINTR
    }
}

/// Whether it is posted within this time from now.
bool is_bell_posted_within(double seconds) {
    timespec until{};
    clock_gettime(CLOCK_MONOTONIC, &until);
    const long nanoseconds = until.tv_nsec + static_cast<long>(seconds * 1e9);
    until.tv_sec += nanoseconds / 1'000'000'000;
    until.tv_nsec = nanoseconds % 1'000'000'000;
    while (sem_clockwait(&bell, CLOCK_MONOTONIC, &until) != 0)
        if (errno != EINTR) return false;
    return true;
}

/// They would go on after us.
void kill_children() {
    std::error_code error;
    for (const auto& task : std::filesystem::directory_iterator("/proc/self/task", error)) {
        std::ifstream children(task.path() / "children");
        for (pid_t child = 0; children >> child;) ::kill(child, SIGKILL);
    }
}

[[noreturn]] void end_program(const std::string& last_words) {
    kill_children();
    TemporaryFile::remove_own();
    if (!last_words.empty()) {
        const std::string text = program_name() + ": " + last_words + "\n";
        [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
    }
    ::_exit(interrupt_exit_code());
}

}  // namespace

InterruptGuard::InterruptGuard(Control& control, std::string last_words, std::function<void()> wake,
                               double grace_seconds)
    : last_words_(std::move(last_words)), wake_(std::move(wake)), grace_seconds_(grace_seconds) {
    assert(watched == nullptr);
    sem_init(&bell, 0, 0);
    watcher_ = std::thread([this] { watch(); });
    watched = &control;
    for (const int signal : kSignals) std::signal(signal, on_signal);
}

InterruptGuard::~InterruptGuard() {
    for (const int signal : kSignals) std::signal(signal, SIG_DFL);
    watched = nullptr;
    over_ = true;
    sem_post(&bell);
    watcher_.join();
}

void InterruptGuard::watch() {
    wait_for_bell();
    if (over_) return;
    if (wake_) wake_();
    while (is_bell_posted_within(grace_seconds_))
        if (over_) return;  // else another signal: the two have a handler each
    end_program(last_words_);
}

int interrupt_exit_code() { return 128 + last_signal; }

}  // namespace elastolab
