#include "cli/progress.hpp"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "base/text.hpp"
#include "base/timer.hpp"

namespace elastolab {

namespace {

constexpr double kSilentSeconds = 1.0;
constexpr int kWidth = 30;

/// What is left of the stage, from what is done of it; empty while too little is done to tell.
std::string left_of_stage(double progress, double seconds) {
    constexpr double kLeastProgress = 0.05;
    if (progress < kLeastProgress || seconds < kSilentSeconds) return "";
    return ", about " + readable_seconds(seconds * (1.0 - progress) / progress) + " left of it";
}

void draw(const Control& control, double seconds, double stage_seconds) {
    const int filled = static_cast<int>(std::lround(kWidth * control.progress()));
    const std::string bar = std::string(static_cast<std::size_t>(filled), '#') +
                            std::string(static_cast<std::size_t>(kWidth - filled), ' ');
    std::fprintf(stderr, "\r[%s] %3.0f %%  %s, %.0f s%s\x1b[K", bar.c_str(), 100.0 * control.progress(),
                 control.stage(), seconds, left_of_stage(control.progress(), stage_seconds).c_str());
}

}  // namespace

ProgressBar::ProgressBar(const Control& control, bool wanted) : control_(control) {
    if (!wanted || isatty(STDERR_FILENO) == 0) return;
    thread_ = std::jthread([this](const std::stop_token& stop) { show(stop); });
}

void ProgressBar::show(const std::stop_token& stop) {
    const Stopwatch watch;
    const char* stage = nullptr;
    double stage_began = 0.0;
    bool drawn = false;
    std::unique_lock lock(mutex_);
    while (!stop.stop_requested()) {
        wake_.wait_for(lock, stop, std::chrono::milliseconds(100), [] { return false; });
        if (control_.stage() != stage) {
            stage = control_.stage();
            stage_began = watch.seconds();
        }
        if (stop.stop_requested() || watch.seconds() < kSilentSeconds) continue;
        draw(control_, watch.seconds(), watch.seconds() - stage_began);
        drawn = true;
    }
    if (drawn) std::fputs("\r\x1b[K", stderr);
}

}  // namespace elastolab
