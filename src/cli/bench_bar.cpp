#include "cli/bench_bar.hpp"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "base/text.hpp"

namespace elastolab {

namespace {

constexpr int kBarWidth = 24;

void draw(const StudyState& state) {
    const auto filled = static_cast<std::size_t>(std::lround(kBarWidth * state.fraction));
    const std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, ' ');
    const std::string left = state.seconds_left < 0.0 ? "" : ", " + readable_seconds(state.seconds_left) + " left";
    std::fprintf(stderr, "\r[%s] %d of %d%s: %s\x1b[K", bar.c_str(), state.n_done, state.n_cases, left.c_str(),
                 state.current.c_str());
}

}  // namespace

BenchBar::BenchBar(const StudyProgress& progress, bool wanted) : progress_(progress) {
    if (!wanted || isatty(STDERR_FILENO) == 0) return;
    thread_ = std::jthread([this](const std::stop_token& stop) { show(stop); });
}

void BenchBar::show(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (!stop.stop_requested()) {
        draw(progress_.state());
        wake_.wait_for(lock, stop, std::chrono::milliseconds(200), [] { return false; });
    }
    std::fputs("\r\x1b[K", stderr);
}

}  // namespace elastolab
