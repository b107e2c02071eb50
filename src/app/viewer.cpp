#include "app/viewer.hpp"

#include <chrono>
#include <cstdlib>
#include <thread>

#include "app/viewer_outputs.hpp"
#include "app/viewer_session.hpp"
#include "app/viewer_start.hpp"
#include "base/timer.hpp"

namespace elastolab {

namespace {

constexpr double kPatienceSeconds = 1.0;  ///< for workers at the end

}  // namespace

void ViewerSession::run() {
    while (!finished()) {
        window_.wait(timeout());
        control_.checkpoint();
        if (must_draw()) draw_frame();
        keep_scene();
        if (!gui_.is_in_use()) keep_preferences();
    }
    keep_preferences();
    pictures_.stop(state_);  // a film that is cut short leaves the handles where they were
    draw_last_picture();
    if (!options_.picture.empty() && nobody_watches() && !replay_) state_.frame_in_viewports(true);  // as deformed
    pictures_.take_at_end(options_, renderer_, state_, palette());
    write_outputs(options_, state_, pictures_.last());
    if (series_) series_->finish();
    state_.files.remove_copy();
    end_workers();
}

void ViewerSession::draw_last_picture() {
    if (options_.screenshot.empty() || pictures_.last() || window_.size().minCoeff() <= 0) return;
    try {
        draw_frame();
    } catch (const std::exception&) {  // write_outputs() reports that there is no picture
    }
}

void ViewerSession::end_workers() {
    pictures_.stop(state_);
    state_.cancel_workers();
    window_.hide();
    const Stopwatch waiting;
    while ((state_.stopping() || pictures_.working()) && waiting.seconds() < kPatienceSeconds)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    if (state_.stopping()) std::_Exit(EXIT_SUCCESS);
}

void run_viewer(const ViewerOptions& options, Control& control) {
    ViewerState state([] { Window::wake(); });
    begin_viewer(state, options, control);
    ViewerSession(options, state, control).run();
}

void run_viewer(const ViewerOptions& options) {
    Control never_cancelled;
    run_viewer(options, never_cancelled);
}

void wake_viewer() { Window::wake(); }

}  // namespace elastolab
