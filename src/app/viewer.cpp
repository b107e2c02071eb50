#include "app/viewer.hpp"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "app/autosave.hpp"
#include "app/dispatch.hpp"
#include "app/input/interaction_log.hpp"
#include "app/panels/gui.hpp"
#include "app/panels/layout.hpp"
#include "app/panels/panels.hpp"
#include "app/picture/palette.hpp"
#include "app/picture/pictures.hpp"
#include "app/picture/scene_renderer.hpp"
#include "app/picture/view_point.hpp"
#include "app/preferences.hpp"
#include "app/series.hpp"
#include "app/six_axis.hpp"
#include "app/viewer_outputs.hpp"
#include "app/viewer_state.hpp"
#include "app/window/start_timeline.hpp"
#include "app/window/window.hpp"
#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/timer.hpp"
#include "scene/user_text.hpp"

namespace elastolab {

namespace {

constexpr double kProgressSeconds = 1.0 / 15.0;  ///< between frames while a progress bar moves
constexpr double kWaitingSeconds = 0.01;         ///< between looks at what the next frame of a film shows
constexpr int kSettlingFrames = 3;               ///< frames that Dear ImGui needs to settle after an event
constexpr double kCheckSeconds = 0.25;           ///< between looks at a check that goes on in the background
constexpr double kCaretSeconds = 0.4;            ///< between frames while a text cursor blinks
constexpr double kPatienceSeconds = 1.0;         ///< for workers at the end
const Eigen::Vector2i kDefaultSize(1280, 800);

/// A replay and how far it is.
struct Replay {
    InteractionLog log;
    std::size_t next = 0;
    bool done() const { return next == log.frames.size(); }
};

class Viewer {
public:
    Viewer(const ViewerOptions& options, Control& control)
        : options_(options),
          control_(control),
          replay_(load_replay(options)),
          window_({.title = "Elastolab",
                   .width = window_size().x(),
                   .height = window_size().y(),
                   .visible = !options.hidden}),
          gui_(window_),
          state_([] { Window::wake(); }),
          pictures_([] { Window::wake(); }),
          autosave_([] { Window::wake(); }) {
        if (options.n_frames > 0 || options.hidden) window_.disable_vsync();
        if (nobody_watches() || !options.scene_out.empty()) state_.unsaved.never_ask();  // that keeps the changes
        if (!options.timings.empty()) state_.measurements.timings = std::make_unique<TimingsRecorder>(options.timings);
        if (!options.timeline.empty()) timeline_.emplace(options.timeline);
        if (!options.record.empty())
            state_.measurements.recorder = std::make_unique<InteractionRecorder>(options.record, window_.size());
        if (!options.series.empty()) series_.emplace(options.series);
        for (const std::filesystem::path& file :
             {options.screenshot, options.picture, options.scene_out, options.mesh_out})
            if (!file.empty()) AtomicFile::require_writable(file);
        if (!nobody_watches()) take(load_preferences());
        open_input();
        if (!nobody_watches()) six_axis_mouse_.emplace([] { Window::wake(); });
        if (!nobody_watches()) state_.recoverable = find_autosaved();
    }

    void run() {
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
        autosave_.clear();
        end_workers();
    }

private:
    static std::optional<Replay> load_replay(const ViewerOptions& options) {
        if (options.replay.empty()) return std::nullopt;
        return Replay{load_interaction(options.replay)};
    }

    Eigen::Vector2i window_size() const {
        if (options_.size) return *options_.size;
        return replay_ ? replay_->log.window_size : kDefaultSize;
    }

    Preferences preferences() const {
        return {state_.tools.navigation, state_.display.dark, state_.display.ui_scale, state_.display.units};
    }
    void take(const Preferences& preferences) {
        state_.tools.navigation = preferences.navigation;
        state_.display.dark = preferences.dark;
        state_.display.ui_scale = preferences.ui_scale;
        state_.display.units = preferences.units;
        kept_preferences_ = preferences;
    }
    void keep_preferences() {
        if (nobody_watches() || kept_preferences_ == preferences()) return;
        kept_preferences_ = preferences();
        save_preferences(kept_preferences_);
    }

    bool nobody_watches() const { return options_.hidden || options_.n_frames > 0; }

    /// Where somebody sees the window, a file that cannot be opened is reported there.
    void open_input() {
        if (!options_.input.empty()) {
            if (nobody_watches())
                state_.open_now(options_.input, control_);
            else
                state_.open(options_.input);
        }
        if (options_.method) state_.start_with(*options_.method);
        if (options_.field) state_.display.field = *options_.field;
        if (options_.cut_axis) {
            state_.display.section = true;
            state_.display.section_axis = *options_.cut_axis;
        }
        state_.update_displacements();  // begins the precomputation
    }

    /// A replay that is over leaves the window to the person.
    bool replaying() const { return replay_ && (options_.hidden || !replay_->done()); }
    bool computing() const { return state_.waiting(); }

    /// The later half of a given number of frames waits until the scene is ready and the model will not be replaced any
    /// more: the set of a completed one is prepared anew.
    bool held_back() const {
        const bool late_frames =
            options_.n_frames > 0 && 2 * (state_.measurements.frame + 1) > options_.n_frames && !replay_;
        return late_frames && (computing() || state_.simulation.busy());
    }

    double timeout() const {
        const double rest = timeout_of_work(), detail = detail_.due_in(Window::seconds());
        return detail < 0.0 || (rest >= 0.0 && rest < detail) ? rest : detail;
    }

    double timeout_of_work() const {
        if (pictures_.filming()) return pictures_.waiting() ? kWaitingSeconds : 0.0;
        if (held_back()) return kProgressSeconds;
        if (options_.n_frames > 0 || pending_frames_ > 0 || !queue_.empty()) return 0.0;
        if (replay_ && !replay_->done() && !state_.simulation.busy()) return 0.0;
        if (computing() || state_.simulation.busy()) return kProgressSeconds;
        if (state_.simulation.checking()) return kCheckSeconds;
        if (const double rest = six_axis_.due_in(Window::seconds()); rest >= 0.0) return rest + 0.01;
        if (message_seconds_ >= 0.0) return std::max(message_seconds_, 0.01);
        const double keeping = state_.gestures.dragging() ? -1.0 : autosave_.due_in(Window::seconds());
        if (!gui_.wants_text()) return keeping;
        return keeping < 0.0 ? kCaretSeconds : std::min(kCaretSeconds, keeping);
    }

    /// A copy of what is not saved, for the case that this process is killed. Not in the midst of a pull, which would
    /// be kept as it began until the next copy is due, nor of a film, which moves handles.
    void keep_scene() {
        if (nobody_watches() || state_.gestures.dragging() || pictures_.filming()) return;
        if (std::optional<AutosavedScene> recovered = state_.take_recovered()) autosave_.adopt(std::move(*recovered));
        autosave_.update(
            {.revision = state_.scene().revision() + (state_.scene_number() << 32),
             .modified = state_.scene().modified(),
             .origin = state_.scene_file(),
             .document =
                 [this] { return movable_document(state_.scene(), state_.method, view_point_of(state_.camera)); }},
            Window::seconds());
        if (state_.keeping_failure == autosave_.failure()) return;
        state_.keeping_failure = autosave_.failure();
        pending_frames_ = kSettlingFrames;
    }

    bool must_draw() {
        std::vector<InputEvent> events = window_.take_events();
        if (!replaying()) queue_.insert(queue_.end(), events.begin(), events.end());
        for (const std::filesystem::path& file : window_.take_dropped_files()) {
            state_.open(file);
            pending_frames_ = kSettlingFrames;  // for the question that it may raise
        }
        if (std::any_of(events.begin(), events.end(), [](const InputEvent& event) { return event.pressed; }))
            six_axis_.end_step(state_);
        if (six_axis_mouse_ && six_axis_.apply(six_axis_mouse_->take(), Window::seconds(), state_))
            pending_frames_ = kSettlingFrames;
        if (pictures_.poll(state_) || pictures_.filming()) pending_frames_ = kSettlingFrames;
        const bool damaged = window_.take_damage();
        if (!queue_.empty() || damaged || state_.simulation.busy() || computing()) pending_frames_ = kSettlingFrames;
        if (detail_.due_in(Window::seconds()) == 0.0) pending_frames_ = std::max(pending_frames_, 1);
        if (message_seconds_ >= 0.0 || gui_.wants_text()) pending_frames_ = std::max(pending_frames_, 1);
        if (window_.close_requested() && !may_close()) pending_frames_ = kSettlingFrames;  // for the question
        if (window_.close_requested()) return false;
        if (held_back()) {
            state_.update_displacements();
            state_.update_picture();
            return false;
        }
        if (options_.n_frames == 0 && pending_frames_ == 0 && !replaying()) {
            const bool checking = state_.simulation.checking();
            const bool changed = state_.update_displacements();
            if (!changed && checking == state_.simulation.checking()) return false;  // nothing new to see
            pending_frames_ = 1;
        }
        return window_.size().minCoeff() > 0;
    }

    /// A window that is closed by hand stays open while a question about unsaved changes waits for its answer.
    bool may_close() {
        if (!state_.requests.quit) state_.quit();
        if (!state_.requests.quit) window_.stay_open();
        return state_.requests.quit;
    }

    /// The events of this frame: from the log when there is one, else as many as one frame can take.
    std::vector<InputEvent> take_events() {
        std::vector<InputEvent> events;
        if (replaying()) {
            if (!replay_->done() && !state_.simulation.busy() && !state_.loading() && state_.measurements.frame > 2)
                events = replay_->log.frames[replay_->next++].events;
        } else {
            const auto n = static_cast<std::ptrdiff_t>(Gui::n_for_one_frame(queue_));
            events.assign(queue_.begin(), queue_.begin() + n);
            queue_.erase(queue_.begin(), queue_.begin() + n);
        }
        if (state_.measurements.recorder && !events.empty())
            state_.measurements.recorder->add({Window::seconds(), events});
        if (!events.empty()) pending_frames_ = kSettlingFrames;
        return events;
    }

    /// No failed edit ends a person's session: the failure becomes a message, and the result is false.
    template <class Action>
    bool guarded(const Action& action) {
        try {
            action();
            return true;
        } catch (const std::exception& error) {
            if (nobody_watches()) throw;
            state_.messages.error(user_text(error));
            return false;
        }
    }

    /// What this frame of a replay answers becomes a step of the series.
    void keep_step() {
        if (!series_ || !replay_ || replay_->next == 0 || state_.simulation.busy()) return;
        const std::vector<LoggedFrame>& frames = replay_->log.frames;
        series_->add(frames[replay_->next - 1].seconds - frames.front().seconds, state_.scene(),
                     state_.simulation.answer(state_.method));
    }

    const Palette& palette() const { return state_.display.dark ? dark_palette() : light_palette(); }

    void draw_frame() {
        const Stopwatch whole;
        const double now = Window::seconds();
        prepare_look();
        const std::vector<InputEvent> events = take_events();
        FrameTimes times;
        Stopwatch part;
        panels_.visit_user_texts(state_, [&](std::string_view text) { gui_.want_characters(text); });
        gui_.begin(events, now - std::exchange(last_frame_seconds_, now));
        const Layout layout = layout_of(window_.size(), gui_.scale(), state_.display);
        window_.set_title(state_.blank() ? "Elastolab" : state_.scene_title() + " \u2013 Elastolab");
        arrange(layout);
        times.gui_ms = 1e3 * part.seconds();

        part = {};
        guarded([&] {
            if (dispatch(events, Window::seconds(), gui_, state_, panels_)) pending_frames_ = kSettlingFrames;
            state_.update_displacements();
        });
        times.update_ms = 1e3 * part.seconds();

        part = {};
        guarded([&] { state_.update_picture(); });
        if (const ShownBody* body = state_.shown.body(state_.method))
            state_.probes.record(now, state_.scene().mesh().vertices, *body, state_.display);
        keep_step();
        renderer_.upload(state_, palette());
        times.upload_ms = 1e3 * part.seconds();

        part = {};
        const double ratio = static_cast<double>(window_.framebuffer_size().x()) / window_.size().x();
        const int n_drawn = renderer_.draw(state_, palette(), ratio, detail_at(now, ratio));
        renderer_.show(state_, ratio, window_.framebuffer_size());
        times.draw_ms = 1e3 * part.seconds();

        part = {};
        if (!guarded([&] { panels_.draw({state_, gui_, layout, palette()}); })) gui_.recover();
        gui_.end();
        times.gui_ms += 1e3 * part.seconds();
        if (!options_.screenshot.empty() && is_last_frame()) pictures_.keep_last(window_);
        pictures_.take_of_window(state_, window_);
        pictures_.take_of_scene(renderer_, state_, palette(), window_);
        part = {};
        window_.swap_buffers();
        if (n_drawn > 0) detail_.took(1e-3 * times.draw_ms + part.seconds());
        times.frame_ms = 1e3 * whole.seconds();
        end_frame(times, now);
    }

    /// All of it where nobody watches.
    DrawingDetail detail_at(double now, double pixel_ratio) {
        if (nobody_watches()) return {};
        if (std::exchange(detailed_scene_, state_.scene_number()) != state_.scene_number()) detail_.forget();
        return detail_.choose(renderer_.has_moved(state_, palette(), pixel_ratio), now);
    }

    /// Lays out the viewports. When their number changes, the body is made to fit again; when their width does, what
    /// filled it still does.
    void arrange(const Layout& layout) {
        const auto width = [&] { return std::min(1.0, state_.shown.viewports.front().place.free_aspect()); };
        const std::size_t before = state_.shown.viewports.size();
        const double width_before = before > 0 ? width() : 1.0;
        state_.shown.viewports = viewports_of(state_, layout.scene, gui_.scale());
        if (state_.shown.viewports.size() != before) return state_.frame_in_viewports(before == 0);
        if (before == 0) return;
        CameraPose pose = state_.camera.pose();
        pose.distance *= width_before / width();
        state_.camera.set_pose(pose);
    }

    void prepare_look() {
        const float scale = window_.content_scale() * state_.display.ui_scale;
        const bool is_new = scale != gui_.scale() || &palette() != styled_palette_;
        gui_.set_scale(scale);
        if (is_new) apply_style(palette(), scale);
        styled_palette_ = &palette();
    }

    bool is_last_frame() const {
        if (window_.close_requested()) return true;
        if (options_.n_frames > 0) return state_.measurements.frame + 1 >= options_.n_frames;
        return replay_over() && options_.hidden;
    }

    bool replay_over() const { return replay_ && replay_->done() && pending_frames_ <= 1 && !state_.simulation.busy(); }

    void end_frame(const FrameTimes& times, double now) {
        state_.measurements.last_frame = times;
        state_.measurements.history.add(times);
        if (state_.measurements.timings) state_.measurements.timings->add(state_.frame_record(times, now));
        if (timeline_) mark_start();
        ++state_.measurements.frame;
        pending_frames_ = std::max(0, pending_frames_ - 1);
        message_seconds_ = state_.messages.expire(now);
        if (state_.requests.quit) window_.request_close();
    }

    /// What this frame is the first to show.
    void mark_start() {
        timeline_->mark(StartTimeline::window);
        if (state_.loading()) return;
        timeline_->mark(StartTimeline::loaded);
        const EmbeddedRunner& shown = state_.simulation.answer(state_.method);
        if (!shown.has_answer()) return;
        timeline_->mark(StartTimeline::answer);
        if (shown.displacement().isZero(0.0)) return;
        timeline_->mark(StartTimeline::moved);
        const MethodRunner& runner = state_.simulation.runner(state_.method);
        if (!state_.simulation.previewing(state_.method) && runner.answers() && runner.refined())
            timeline_->mark(StartTimeline::exact);
    }

    bool finished() const {
        if (window_.close_requested()) return true;
        if (options_.n_frames > 0) return state_.measurements.frame >= options_.n_frames;
        return replay_over() && options_.hidden;
    }

    /// Closed by hand: one more frame, for the picture. Where it fails the other outputs are written all the same.
    void draw_last_picture() {
        if (options_.screenshot.empty() || pictures_.last() || window_.size().minCoeff() <= 0) return;
        try {
            draw_frame();
        } catch (const std::exception&) {  // write_outputs() reports that there is no picture
        }
    }

    /// A worker inside a library call that cannot be interrupted must not keep a closed window's process alive:
    /// everything that was to be written is.
    void end_workers() {
        pictures_.stop(state_);
        state_.cancel_workers();
        window_.hide();
        const Stopwatch waiting;
        while ((state_.stopping() || pictures_.working()) && waiting.seconds() < kPatienceSeconds)
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        if (state_.stopping()) std::_Exit(EXIT_SUCCESS);
    }

    ViewerOptions options_;
    Control& control_;
    std::optional<Replay> replay_;
    Window window_;
    Gui gui_;
    ViewerState state_;
    SceneRenderer renderer_;
    Panels panels_;
    Pictures pictures_;
    Autosave autosave_;
    std::optional<SixAxisMouse> six_axis_mouse_;  ///< none where nobody watches
    SixAxisControl six_axis_;
    std::optional<StartTimeline> timeline_;
    std::optional<SeriesWriter> series_;
    std::vector<InputEvent> queue_;
    int pending_frames_ = kSettlingFrames;
    double last_frame_seconds_ = 0.0, message_seconds_ = -1.0;
    const Palette* styled_palette_ = nullptr;
    Preferences kept_preferences_;
    DetailKeeper detail_;
    std::uint64_t detailed_scene_ = 0;  ///< the number of the scene that it knows
};

}  // namespace

void run_viewer(const ViewerOptions& options, Control& control) { Viewer(options, control).run(); }

void run_viewer(const ViewerOptions& options) {
    Control never_cancelled;
    run_viewer(options, never_cancelled);
}

void wake_viewer() { Window::wake(); }

}  // namespace elastolab
