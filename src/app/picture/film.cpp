#include "app/picture/film.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <system_error>
#include <utility>

#include "app/job_notes.hpp"
#include "base/error.hpp"
#include "base/overloaded.hpp"
#include "base/program.hpp"
#include "base/text.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

constexpr int kFramesPerSecond = 30;
constexpr double kNearRest = 1e-6;  ///< least part of the deformation, as the range of colours is divided by it

/// ffmpeg reads '%' as the place of a frame's number.
std::string frame_pattern(const fs::path& file) {
    std::string text;
    for (const char c : fs::path(file).replace_extension().string()) text += c == '%' ? "%%" : std::string(1, c);
    return text + "-%04d" + file.extension().string();
}

LoadValue scaled(LoadValue load, double part) {
    std::visit(
        Overloaded{[&](ForceLoad& value) { value.force *= part; }, [&](TractionLoad& value) { value.traction *= part; },
                   [&](PressureLoad& value) { value.pressure *= part; }},
        load);
    return load;
}

std::string last_line(std::string text) {
    while (!text.empty() && text.back() == '\n') text.pop_back();
    return one_line(text.substr(text.rfind('\n') + 1));
}

}  // namespace

fs::path frame_file(const fs::path& file, int frame) {
    fs::path numbered = file;
    numbered.replace_filename(file.stem().string() + formatted("-%04d", frame) + file.extension().string());
    return numbered;
}

std::string video_obstacle() {
    return find_program("ffmpeg") ? "" : "ffmpeg, which makes the video, is not installed. The frames are written.";
}

fs::path make_video(const fs::path& file, Control& control) {
    const std::optional<fs::path> ffmpeg = find_program("ffmpeg");
    fs::path video = fs::path(file).replace_extension(".mp4");
    if (!ffmpeg) throw Error(video.string() + ": ffmpeg is not installed. Install it; the frames are there.");
    const fs::path partial = fs::path(file).replace_extension(".partial.mp4");
    std::string log;
    std::error_code error;
    int code = 1;
    try {
        code = run_program(*ffmpeg,
                           {"-nostdin", "-loglevel", "error", "-y", "-framerate", std::to_string(kFramesPerSecond),
                            "-start_number", "1", "-i", "file:" + frame_pattern(file), "-vf",
                            "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", "file:" + partial.string()},
                           log, control);
    } catch (...) {
        fs::remove(partial, error);
        throw;
    }
    if (code == 0) fs::rename(partial, video, error);
    if (code == 0 && !error) return video;
    if (error) log = error.message();
    fs::remove(partial, error);
    throw Error(video.string() + ": ffmpeg could not make it (" + last_line(log) + "). The frames are there.");
}

double pulled_part(int frame, int n_frames) {
    return 0.5 * (1.0 - std::cos(2.0 * std::numbers::pi * (frame - 1) / n_frames));
}

bool pull_scales(const ViewerState& state) {
    constexpr double kStraight = 1e-9;
    const std::vector<MethodKind> kinds = state.needed_kinds();
    if (!std::all_of(kinds.begin(), kinds.end(), [](MethodKind kind) { return kind->linear; })) return false;
    const LiveScene& scene = state.scene();
    for (int h = 0; h < scene.n_handles(); ++h) {
        const Positions rest = scene.rest_positions(h);
        const Motion& motion = scene.constraints().motions[static_cast<std::size_t>(h)];
        const Eigen::Matrix3Xd whole = displacements(motion, rest),
                               half = displacements(part_of(motion, 0.5, rest), rest);
        if ((2.0 * half - whole).cwiseAbs().maxCoeff() > kStraight * whole.cwiseAbs().maxCoeff()) return false;
    }
    return true;
}

Film::Pose::Pose(const ViewerState& state) : range(state.shown.field_range(state.display)) {
    const LiveScene& scene = state.scene();
    const Document& document = scene.document();
    for (int h = 0; h < scene.n_handles(); ++h) {
        const Motion& motion = scene.constraints().motions[static_cast<std::size_t>(h)];
        handles.push_back({scene.handle_name(h), motion, motion, document.handles[static_cast<std::size_t>(h)].force});
    }
    for (int l = 0; l < scene.n_loads(); ++l) {
        const LoadValue& value = document.loads[static_cast<std::size_t>(l)].value;
        loads.push_back({scene.load_name(l), value, value});
    }
    whole_gravity = gravity = document.gravity;
    revision = scene.revision();
}

void Film::Pose::put(LiveScene& scene, double part) {
    for (int h = 0; h < scene.n_handles(); ++h) {
        Handle& handle = handles[static_cast<std::size_t>(h)];
        handle.part = part_of(handle.whole, part, scene.rest_positions(h));
        scene.set_motion(h, handle.part);
    }
    for (int l = 0; l < scene.n_loads(); ++l) {
        Load& load = loads[static_cast<std::size_t>(l)];
        load.part = scaled(load.whole, part);
        scene.set_load(l, load.part);
    }
    if (whole_gravity) {
        gravity = part * *whole_gravity;
        scene.set_gravity(gravity, scene.document().density);
    }
    revision = scene.revision();
}

/// What still is as the film has made it, by its name, becomes what it was.
void Film::Pose::put_back(LiveScene& scene) const {
    for (int h = 0; h < scene.n_handles(); ++h)
        for (const Handle& handle : handles)
            if (handle.name == scene.handle_name(h) &&
                handle.part == scene.constraints().motions[static_cast<std::size_t>(h)]) {
                scene.set_motion(h, handle.whole);
                if (handle.force) scene.set_force(h, handle.force);
            }
    for (int l = 0; l < scene.n_loads(); ++l)
        for (const Load& load : loads)
            if (load.name == scene.load_name(l) &&
                load.part == scene.document().loads[static_cast<std::size_t>(l)].value)
                scene.set_load(l, load.whole);
    if (gravity && scene.document().gravity == gravity) scene.set_gravity(whole_gravity, scene.document().density);
}

/// Whether the body is as it is to be in this frame; else that is under way.
bool Film::pose(SceneRenderer& renderer, ViewerState& state, const Palette& palette) {
    if (!pose_) {
        state.posed_for_film = true;
        pose_.emplace(state);
    }
    if (state.scene().revision() != pose_->revision)
        throw Error(request_.file.string() + ": the scene was changed while the film was made. Make it anew.");
    if (!waiting_) pose_->put(state.scene(), pulled_part(next_, request_.n_frames));
    state.update_displacements();
    state.update_picture();
    waiting_ = state.answering();
    if (!waiting_) renderer.upload(state, palette);
    return !waiting_;
}

/// Nothing is put back in another scene.
void Film::put_back(ViewerState& state) {
    waiting_ = state.posed_for_film = false;
    if (pose_ && scene_number_ == state.scene_number()) pose_->put_back(state.scene());
    pose_.reset();
}

/// A linear method scales all displacements, and all values that are coloured, by the part of a straight pull.
void Film::draw(SceneRenderer& renderer, ViewerState& state, const Palette& palette, int frame) const {
    const CameraPose pose = state.camera.pose();
    const DisplaySettings display = state.display;
    PictureOptions options{request_.transparent, request_.legend ? legend_of(state) : std::nullopt};
    const auto restore = [&] {
        state.camera.set_pose(pose);
        state.display = display;
        state.update_picture();
        renderer.upload(state, palette);
    };
    try {
        if (request_.kind == FilmKind::turn) {
            state.camera.set_pose(turned(state.camera, pose, static_cast<double>(frame - 1) / request_.n_frames));
        } else if (pose_) {
            state.display.typed_ranges[display.field] = pose_->range;
            if (options.legend) options.legend = legend_of(state);
            state.update_picture();
            renderer.upload(state, palette);
        } else {
            const double part = std::max(kNearRest, pulled_part(frame, request_.n_frames));
            const auto [low, high] = state.shown.field_range(display);
            state.display.deformation_scale *= part;
            state.display.typed_ranges[display.field] = {low / part, high / part};
            state.update_picture();
            renderer.upload(state, palette);
        }
        write_picture(frame_file(request_.file, frame), renderer, state, palette, request_.size, options);
    } catch (...) {
        restore();
        throw;
    }
    restore();
}

void Film::step(SceneRenderer& renderer, ViewerState& state, const Palette& palette) {
    const int frame = std::exchange(next_, 0);  // an exception ends it
    if (frame == 1 && !pose_) {
        state.finish_gesture();
        scene_number_ = state.scene_number();
    }
    try {
        if (scene_number_ != state.scene_number())
            throw Error(request_.file.string() + ": another scene was opened while the film was made. Make it anew.");
        if (request_.kind == FilmKind::pull && (pose_ || !pull_scales(state))) {
            next_ = frame;
            if (!pose(renderer, state, palette)) return;
        }
        next_ = 0;
        draw(renderer, state, palette, frame);
    } catch (...) {
        next_ = 0;
        put_back(state);
        state.pictures_under_way.reset();
        throw;
    }
    state.pictures_under_way = PictureProgress{frame, request_.n_frames};
    if (frame == request_.n_frames) return finish(state);
    next_ = frame + 1;
}

void Film::finish(ViewerState& state) {
    put_back(state);
    state.pictures_under_way.reset();
    state.messages.note("Saved " + std::to_string(request_.n_frames) + " frames, " +
                        frame_file(request_.file, 1).string() + " and on");
    if (request_.video)
        video_.start(
            [file = request_.file](Control& control) { return "Saved " + make_video(file, control).string(); });
}

void Film::stop(ViewerState& state) {
    next_ = 0;
    put_back(state);
    video_.cancel();
}

bool Film::poll(ViewerState& state) { return tell_end(video_, state.messages); }

}  // namespace elastolab
