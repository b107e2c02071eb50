#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "app/files/series.hpp"
#include "app/input/interaction_log.hpp"
#include "app/panels/gui.hpp"
#include "app/panels/layout.hpp"
#include "app/panels/panels.hpp"
#include "app/picture/palette.hpp"
#include "app/picture/pictures.hpp"
#include "app/picture/scene_renderer.hpp"
#include "app/preferences.hpp"
#include "app/six_axis.hpp"
#include "app/viewer.hpp"
#include "app/viewer_start.hpp"
#include "app/viewer_state.hpp"
#include "app/window/six_axis_mouse.hpp"
#include "app/window/start_timeline.hpp"
#include "app/window/window.hpp"
#include "scene/user_text.hpp"

namespace elastolab {

/// A replay and how far it is.
struct Replay {
    InteractionLog log;
    std::size_t next = 0;
    bool done() const { return next == log.frames.size(); }
};

/// One run of the viewer: a window with all that it shows. How it begins is in viewer_start.cpp, when it draws and what
/// it waits for in viewer_schedule.cpp, what a frame is in viewer_frame.cpp, and how it ends in viewer.cpp.
class ViewerSession {
public:
    /// `state` has begun (begin_viewer()).
    ViewerSession(const ViewerOptions& options, ViewerState& state, Control& control);
    /// Until the window is closed, or all is done that `options` ask for. Throws what went wrong where nobody watches.
    void run();

private:
    static std::optional<Replay> load_replay(const ViewerOptions& options);
    Eigen::Vector2i window_size() const;
    Preferences preferences() const;
    void take(const Preferences& preferences);
    void keep_preferences();
    bool nobody_watches() const { return elastolab::nobody_watches(options_); }

    /// A replay that is over leaves the window to the person.
    bool replaying() const { return replay_ && (options_.hidden || !replay_->done()); }
    bool computing() const { return state_.waiting(); }
    /// The same, or the simulation works on an answer or on what one is made of.
    bool workers_compute() const { return computing() || state_.simulation.busy(); }

    /// The later half of a given number of frames waits until the scene is ready and the model will not be replaced any
    /// more: the set of a completed one is prepared anew.
    bool held_back() const;
    /// Somebody waits for the first answer, and software OpenGL would take the cores that compute it.
    bool hurries() const;
    /// While it is waited for, frames that only follow the cursor come with a rest in between: how much of that is left
    /// [s]; 0: the next frame may be drawn.
    double rest_for_workers() const;
    double timeout() const;
    double timeout_of_work() const;

    /// A copy of what is not saved, for the case that this process is killed. Not in the midst of a pull, which would
    /// be kept as it began until the next copy is due, nor of a film, which moves handles.
    void keep_scene();
    bool must_draw();
    bool update_displacements();

    /// A window that is closed by hand stays open while a question about unsaved changes waits for its answer.
    bool may_close();

    /// The events of this frame: from the log when there is one, else as many as one frame can take.
    std::vector<InputEvent> take_events();
    bool has_size_of_replay();
    std::vector<InputEvent> events_for_scene(std::vector<InputEvent> events);
    bool waits_for_field();

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
    void keep_step();
    const Palette& palette() const { return state_.display.dark ? dark_palette() : light_palette(); }

    void draw_frame();

    /// All of it where nobody watches.
    DrawingDetail detail_at(double now, double pixel_ratio);

    /// Lays out the viewports. When their number changes, the body is made to fit again; when their width does, what
    /// filled it still does.
    void arrange(const Layout& layout);
    void prepare_look();
    bool is_last_frame() const;
    bool replay_over() const;
    void end_frame(const FrameTimes& times, double now);

    /// What this frame is the first to show.
    void mark_start();
    bool finished() const;

    /// Closed by hand: one more frame, for the picture. Where it fails the other outputs are written all the same.
    void draw_last_picture();

    /// A worker inside a library call that cannot be interrupted must not keep a closed window's process alive:
    /// everything that was to be written is.
    void end_workers();

    ViewerOptions options_;
    Control& control_;
    std::optional<Replay> replay_;
    Window window_;
    Gui gui_;
    ViewerState& state_;
    SceneRenderer renderer_;
    Panels panels_;
    Pictures pictures_;
    std::optional<SixAxisMouse> six_axis_mouse_;  ///< none where nobody watches
    SixAxisControl six_axis_;
    std::optional<StartTimeline> timeline_;
    std::optional<SeriesWriter> series_;
    std::vector<InputEvent> queue_;
    std::vector<InputEvent> kept_events_;      ///< that the scene has in the next frame
    static constexpr int kSettlingFrames = 3;  ///< frames that Dear ImGui needs to settle after an event
    static constexpr int kFramesForField = 6;  ///< frames in which a field takes the keys, or will not
    int frames_for_field_ = 0, frames_for_size_ = 0;
    int pending_frames_ = kSettlingFrames;  ///< that are drawn whatever comes
    double last_frame_seconds_ = 0.0, message_seconds_ = -1.0;
    const Palette* styled_palette_ = nullptr;
    Preferences kept_preferences_;
    DetailKeeper detail_;
    std::uint64_t detailed_scene_ = 0;  ///< the number of the scene that it knows
};

}  // namespace elastolab
