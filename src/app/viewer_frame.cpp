// One frame of the viewer: panels, gestures, answers, pictures, in this order.
#include <algorithm>
#include <utility>

#include "app/dispatch.hpp"
#include "app/viewer_session.hpp"
#include "base/timer.hpp"

namespace elastolab {

void ViewerSession::draw_frame() {
    const Stopwatch whole;
    const double now = Window::seconds();
    prepare_look();
    const std::vector<InputEvent> events = take_events();
    FrameTimes times;
    Stopwatch part;
    panels_.visit_user_texts(state_, [&](std::string_view text) { gui_.want_characters(text); });
    gui_.begin(events, now - std::exchange(last_frame_seconds_, now));
    const Layout layout = layout_of(window_.size(), gui_.scale(), state_.display);
    // What a film moves is no change of the scene.
    if (!state_.posed_for_film)
        window_.set_title(state_.blank() ? "Elastolab" : state_.files.title() + " \u2013 Elastolab");
    arrange(layout);
    times.gui_ms = 1e3 * part.seconds();

    part = {};
    guarded([&] {
        if (dispatch(events_for_scene(events), Window::seconds(), gui_, state_, panels_))
            pending_frames_ = kSettlingFrames;
        if (panels_.selection().asks_name()) frames_for_field_ = kFramesForField;
        state_.update_displacements();
    });
    times.update_ms = 1e3 * part.seconds();

    part = {};
    guarded([&] { state_.update_picture(); });
    state_.record_probes(now);
    keep_step();
    renderer_.upload(state_, palette());
    times.upload_ms = 1e3 * part.seconds();

    part = {};
    const double ratio = static_cast<double>(window_.framebuffer_size().x()) / window_.size().x();
    const int n_drawn = renderer_.draw(state_, palette(), ratio, detail_at(now, ratio));
    renderer_.show(state_, palette(), ratio, window_.framebuffer_size());
    times.draw_ms = 1e3 * part.seconds();
    // The first picture takes long, as shaders are compiled for it. What workers have ready by then has not to wait.
    if (state_.measurements.frame == 0) guarded([&] { state_.update_displacements(); });

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

/// A press beside a field that is typed into ends the typing, of what is selected still: the scene has it a frame
/// later.
std::vector<InputEvent> ViewerSession::events_for_scene(std::vector<InputEvent> events) {
    std::vector<InputEvent> all = std::exchange(kept_events_, {});
    all.insert(all.end(), events.begin(), events.end());
    const auto is_press = [](const InputEvent& event) {
        return event.kind == InputEvent::Kind::button && event.pressed;
    };
    if (!gui_.wants_text() || gui_.wants_mouse() || std::none_of(events.begin(), events.end(), is_press)) return all;
    pending_frames_ = kSettlingFrames;
    kept_events_ = std::move(all);
    return {};
}

DrawingDetail ViewerSession::detail_at(double now, double pixel_ratio) {
    if (nobody_watches()) return {};
    if (std::exchange(detailed_scene_, state_.scene_number()) != state_.scene_number()) detail_.forget();
    const bool moves = hurries() || renderer_.has_moved(state_, palette(), pixel_ratio);
    return detail_.choose(moves, now, !workers_compute());
}

void ViewerSession::arrange(const Layout& layout) {
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

void ViewerSession::prepare_look() {
    const float scale = window_.content_scale() * state_.display.ui_scale;
    const bool is_new = scale != gui_.scale() || &palette() != styled_palette_;
    gui_.set_scale(scale);
    if (is_new) apply_style(palette(), scale);
    styled_palette_ = &palette();
}

void ViewerSession::keep_step() {
    if (!series_ || !replay_ || replay_->next == 0 || state_.simulation.busy()) return;
    const std::vector<LoggedFrame>& frames = replay_->log.frames;
    series_->add(frames[replay_->next - 1].seconds - frames.front().seconds, state_.scene(),
                 state_.simulation.answer(state_.method));
}

void ViewerSession::end_frame(const FrameTimes& times, double now) {
    state_.measurements.last_frame = times;
    state_.measurements.history.add(times);
    if (state_.measurements.timings) state_.measurements.timings->add(state_.frame_record(times, now));
    if (timeline_) mark_start();
    ++state_.measurements.frame;
    pending_frames_ = std::max(0, pending_frames_ - 1);
    message_seconds_ = state_.messages.expire(now);
    if (state_.requests.quit) window_.request_close();
}

void ViewerSession::mark_start() {
    timeline_->mark(StartTimeline::window);
    if (state_.files.loading()) return;
    timeline_->mark(StartTimeline::loaded);
    const EmbeddedRunner& shown = state_.simulation.answer(state_.method);
    if (!shown.has_answer()) return;
    timeline_->mark(StartTimeline::answer);
    if (shown.displacement().isZero(0.0)) return;
    timeline_->mark(StartTimeline::moved);
    const MethodRunner& runner = state_.simulation.runner(state_.method);
    if (!state_.simulation.previewing(state_.method) && runner.answers() && runner.converged())
        timeline_->mark(StartTimeline::exact);
}

}  // namespace elastolab
