// How the viewer begins: the window, what the options ask for, and what was kept from the last time.
#include "app/viewer_start.hpp"

#include <memory>

#include "app/viewer_session.hpp"
#include "base/atomic_file.hpp"

namespace elastolab {

namespace {

const Eigen::Vector2i kDefaultSize(1280, 800);

}  // namespace

bool nobody_watches(const ViewerOptions& options) { return options.hidden || options.n_frames > 0; }

void begin_viewer(ViewerState& state, const ViewerOptions& options, Control& control) {
    const bool keeps_changes = !options.scene_out.empty();
    if (nobody_watches(options) || keeps_changes) state.files.unsaved.never_ask();
    for (const std::filesystem::path& file : {options.screenshot, options.picture, options.scene_out, options.mesh_out})
        if (!file.empty()) AtomicFile::require_writable(file);
    if (!options.input.empty()) {
        if (nobody_watches(options))
            state.files.open_now(options.input, control);
        else
            state.files.open(options.input);
    }
    state.start_with(options.asked);
    state.update_displacements();  // begins the precomputation
}

ViewerSession::ViewerSession(const ViewerOptions& options, ViewerState& state, Control& control)
    : options_(options),
      control_(control),
      replay_(load_replay(options)),
      window_(
          {.title = "Elastolab", .width = window_size().x(), .height = window_size().y(), .visible = !options.hidden}),
      gui_(window_),
      state_(state),
      pictures_([] { Window::wake(); }) {
    state_.update_displacements();  // goes on with what is ready by now
    if (options.n_frames > 0 || options.hidden) window_.disable_vsync();
    if (!options.timings.empty()) state_.measurements.timings = std::make_unique<TimingsRecorder>(options.timings);
    if (!options.timeline.empty()) timeline_.emplace(options.timeline);
    if (!options.record.empty())
        state_.measurements.recorder = std::make_unique<InteractionRecorder>(options.record, window_.size());
    if (!options.series.empty()) series_.emplace(options.series);
    if (nobody_watches()) return;
    take(load_preferences());
    six_axis_mouse_.emplace([] { Window::wake(); });
    state_.files.recoverable = find_autosaved();
}

std::optional<Replay> ViewerSession::load_replay(const ViewerOptions& options) {
    if (options.replay.empty()) return std::nullopt;
    return Replay{load_interaction(options.replay)};
}

Eigen::Vector2i ViewerSession::window_size() const {
    if (options_.size) return *options_.size;
    return replay_ ? replay_->log.window_size : kDefaultSize;
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
