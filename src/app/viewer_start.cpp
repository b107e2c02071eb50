// How the viewer begins: the window, what the options ask for, and what was kept from the last time.
#include <memory>

#include "app/viewer_session.hpp"
#include "base/atomic_file.hpp"

namespace elastolab {

namespace {

const Eigen::Vector2i kDefaultSize(1280, 800);

}  // namespace

ViewerSession::ViewerSession(const ViewerOptions& options, Control& control)
    : options_(options),
      control_(control),
      replay_(load_replay(options)),
      window_(
          {.title = "Elastolab", .width = window_size().x(), .height = window_size().y(), .visible = !options.hidden}),
      gui_(window_),
      state_([] { Window::wake(); }),
      pictures_([] { Window::wake(); }) {
    if (options.n_frames > 0 || options.hidden) window_.disable_vsync();
    if (nobody_watches() || !options.scene_out.empty()) state_.files.unsaved.never_ask();  // that keeps the changes
    if (!options.timings.empty()) state_.measurements.timings = std::make_unique<TimingsRecorder>(options.timings);
    if (!options.timeline.empty()) timeline_.emplace(options.timeline);
    if (!options.record.empty())
        state_.measurements.recorder = std::make_unique<InteractionRecorder>(options.record, window_.size());
    if (!options.series.empty()) series_.emplace(options.series);
    for (const std::filesystem::path& file : {options.screenshot, options.picture, options.scene_out, options.mesh_out})
        if (!file.empty()) AtomicFile::require_writable(file);
    if (!nobody_watches()) take(load_preferences());
    open_input();
    if (!nobody_watches()) six_axis_mouse_.emplace([] { Window::wake(); });
    if (!nobody_watches()) state_.files.recoverable = find_autosaved();
}

std::optional<Replay> ViewerSession::load_replay(const ViewerOptions& options) {
    if (options.replay.empty()) return std::nullopt;
    return Replay{load_interaction(options.replay)};
}

Eigen::Vector2i ViewerSession::window_size() const {
    if (options_.size) return *options_.size;
    return replay_ ? replay_->log.window_size : kDefaultSize;
}

void ViewerSession::open_input() {
    if (!options_.input.empty()) {
        if (nobody_watches())
            state_.files.open_now(options_.input, control_);
        else
            state_.files.open(options_.input);
    }
    if (options_.method) state_.start_with(*options_.method);
    if (options_.field) state_.display.field = *options_.field;
    if (options_.cut_axis) {
        state_.display.section = true;
        state_.display.section_axis = *options_.cut_axis;
    }
    state_.update_displacements();  // begins the precomputation
}

Preferences ViewerSession::preferences() const {
    return {state_.tools.navigation, state_.display.dark, state_.display.ui_scale, state_.display.units};
}

void ViewerSession::take(const Preferences& preferences) {
    state_.tools.navigation = preferences.navigation;
    state_.display.dark = preferences.dark;
    state_.display.ui_scale = preferences.ui_scale;
    state_.display.units = preferences.units;
    kept_preferences_ = preferences;
}

void ViewerSession::keep_preferences() {
    if (nobody_watches() || kept_preferences_ == preferences()) return;
    kept_preferences_ = preferences();
    save_preferences(kept_preferences_);
}

}  // namespace elastolab
