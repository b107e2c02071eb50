// When the viewer draws a frame, which events that has, and what it waits for in between.
#include <algorithm>
#include <string>
#include <utility>

#include "app/viewer_session.hpp"
#include "base/error.hpp"

namespace elastolab {

namespace {

constexpr double kProgressSeconds = 1.0 / 15.0;  ///< between frames while a progress bar moves
/// Between frames that settle while workers compute, who may want the cores that draw: software OpenGL takes them all.
constexpr double kSettlingSeconds = kProgressSeconds;
/// Between frames while the first answer is waited for: times as long as the frame before took, and at most [s].
constexpr double kRestForWorkers = 4.0, kLongestRest = 0.1;
constexpr double kWaitingSeconds = 0.01;  ///< between looks at what the next frame of a film shows
constexpr double kCheckSeconds = 0.25;    ///< between looks at a check that goes on in the background
constexpr double kCaretSeconds = 0.4;     ///< between frames while a text cursor blinks

}  // namespace

bool ViewerSession::held_back() const {
    const bool late_frames =
        options_.n_frames > 0 && 2 * (state_.measurements.frame + 1) > options_.n_frames && !replay_;
    return late_frames && workers_compute();
}

bool ViewerSession::hurries() const {
    return state_.simulation.preparing_preview() || state_.simulation.proxies().running();
}

double ViewerSession::rest_for_workers() const {
    if (!hurries() || options_.n_frames > 0 || replaying()) return 0.0;
    const bool follows_only = std::all_of(
        queue_.begin(), queue_.end(), [](const InputEvent& event) { return event.kind == InputEvent::Kind::cursor; });
    if (!follows_only) return 0.0;
    const double took = 1e-3 * state_.measurements.last_frame.frame_ms;
    const double rest = std::min(kRestForWorkers * took, kLongestRest);
    return std::max(0.0, last_frame_seconds_ + took + rest - Window::seconds());
}

double ViewerSession::timeout() const {
    const double rest = timeout_of_work(), detail = detail_.due_in(Window::seconds());
    return detail < 0.0 || (rest >= 0.0 && rest < detail) ? rest : detail;
}

double ViewerSession::timeout_of_work() const {
    if (pictures_.filming()) return pictures_.waiting() ? kWaitingSeconds : 0.0;
    if (held_back()) return kProgressSeconds;
    if (const double rest = rest_for_workers(); rest > 0.0) return rest;
    if (options_.n_frames > 0 || !queue_.empty()) return 0.0;
    if (pending_frames_ > 0) return workers_compute() ? kSettlingSeconds : 0.0;
    if (replay_ && !replay_->done() && !state_.simulation.busy()) return 0.0;
    if (workers_compute()) return kProgressSeconds;
    if (state_.simulation.checking()) return kCheckSeconds;
    if (const double rest = six_axis_.due_in(Window::seconds()); rest >= 0.0) return rest + 0.01;
    if (message_seconds_ >= 0.0) return std::max(message_seconds_, 0.01);
    const double keeping = state_.gestures.dragging() ? -1.0 : state_.files.copy_due_in(Window::seconds());
    if (!gui_.wants_text()) return keeping;
    return keeping < 0.0 ? kCaretSeconds : std::min(kCaretSeconds, keeping);
}

void ViewerSession::keep_scene() {
    if (nobody_watches() || state_.gestures.dragging() || pictures_.filming()) return;
    if (state_.files.keep_copy(Window::seconds())) pending_frames_ = kSettlingFrames;
}

bool ViewerSession::must_draw() {
    std::vector<InputEvent> events = window_.take_events();
    if (!replaying()) queue_.insert(queue_.end(), events.begin(), events.end());
    for (const std::filesystem::path& file : window_.take_dropped_files()) {
        state_.files.open(file);
        pending_frames_ = kSettlingFrames;  // for the question that it may raise
    }
    if (std::any_of(events.begin(), events.end(), [](const InputEvent& event) { return event.pressed; }))
        six_axis_.end_step(state_);
    if (six_axis_mouse_ && six_axis_.apply(six_axis_mouse_->take(), Window::seconds(), state_))
        pending_frames_ = kSettlingFrames;
    if (pictures_.poll(state_) || pictures_.filming()) pending_frames_ = kSettlingFrames;
    const bool damaged = window_.take_damage();
    if (!queue_.empty() || damaged) pending_frames_ = kSettlingFrames;
    if (workers_compute()) pending_frames_ = std::max(pending_frames_, 1);
    if (detail_.due_in(Window::seconds()) == 0.0) pending_frames_ = std::max(pending_frames_, 1);
    if (message_seconds_ >= 0.0 || gui_.wants_text()) pending_frames_ = std::max(pending_frames_, 1);
    if (window_.close_requested() && !may_close()) pending_frames_ = kSettlingFrames;  // for the question
    if (window_.close_requested()) return false;
    if (held_back()) {
        update_displacements();
        guarded([&] { state_.update_picture(); });
        return false;
    }
    if (rest_for_workers() > 0.0 && !update_displacements()) return false;
    if (options_.n_frames == 0 && pending_frames_ == 0 && !replaying()) {
        const bool checking = state_.simulation.checking();
        const bool changed = update_displacements();
        if (!changed && checking == state_.simulation.checking()) return false;  // nothing new to see
        pending_frames_ = 1;
    }
    return window_.size().minCoeff() > 0;
}

/// Whether there is something new to see.
bool ViewerSession::update_displacements() {
    bool changed = false;
    return !guarded([&] { changed = state_.update_displacements(); }) || changed;
}

bool ViewerSession::may_close() {
    if (!state_.requests.quit) state_.quit();
    if (!state_.requests.quit) window_.stay_open();
    return state_.requests.quit;
}

/// A field was asked for and takes no letters yet: they would be shortcuts meanwhile.
bool ViewerSession::waits_for_field() {
    if (frames_for_field_ == 0) return false;
    frames_for_field_ = gui_.wants_text() ? 0 : frames_for_field_ - 1;
    pending_frames_ = kSettlingFrames;
    return frames_for_field_ > 0;
}

/// Events are of places in the window: it has to be as large as it was. A window manager may not let it.
bool ViewerSession::has_size_of_replay() {
    constexpr int kPatience = 200;  // frames
    const std::optional<Eigen::Vector2i>& wanted = replay_->log.frames[replay_->next].window_size;
    if (!wanted || window_.size() == *wanted) {
        frames_for_size_ = 0;
        return true;
    }
    if (frames_for_size_++ == 0) window_.set_size(*wanted);
    pending_frames_ = kSettlingFrames;
    if (frames_for_size_ < kPatience) return false;
    replay_->next = replay_->log.frames.size();
    guarded([&] {
        throw Error("replay: the window cannot be made " + std::to_string(wanted->x()) + "x" +
                    std::to_string(wanted->y()) + ", as it was when this was recorded. Replay it with --hidden.");
    });
    return false;
}

std::vector<InputEvent> ViewerSession::take_events() {
    std::vector<InputEvent> events;
    if (waits_for_field()) return events;
    if (replaying()) {
        if (!replay_->done() && !state_.simulation.busy() && !state_.files.loading() && state_.measurements.frame > 2 &&
            has_size_of_replay())
            events = replay_->log.frames[replay_->next++].events;
    } else {
        const auto n = static_cast<std::ptrdiff_t>(Gui::n_for_one_frame(queue_));
        events.assign(queue_.begin(), queue_.begin() + n);
        queue_.erase(queue_.begin(), queue_.begin() + n);
    }
    if (state_.measurements.recorder && !events.empty())
        state_.measurements.recorder->add({Window::seconds(), events, window_.size()});
    if (!events.empty()) pending_frames_ = kSettlingFrames;
    return events;
}

bool ViewerSession::is_last_frame() const {
    if (window_.close_requested()) return true;
    if (options_.n_frames > 0) return state_.measurements.frame + 1 >= options_.n_frames;
    return replay_over() && options_.hidden;
}

bool ViewerSession::replay_over() const {
    return replay_ && replay_->done() && pending_frames_ <= 1 && !state_.simulation.busy();
}

bool ViewerSession::finished() const {
    if (window_.close_requested()) return true;
    if (options_.n_frames > 0) return state_.measurements.frame >= options_.n_frames;
    return replay_over() && options_.hidden;
}

}  // namespace elastolab
