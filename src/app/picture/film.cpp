#include "app/picture/film.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <system_error>
#include <utility>

#include "app/job_notes.hpp"
#include "base/error.hpp"
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

/// Elasticity is linear: a part of the pull scales all displacements, and all values that are coloured, by that part.
void Film::draw(SceneRenderer& renderer, ViewerState& state, const Palette& palette, int frame) const {
    const CameraPose pose = state.camera.pose();
    const DisplaySettings display = state.display;
    const PictureOptions options{request_.transparent, request_.legend ? legend_of(state) : std::nullopt};
    const auto restore = [&] {
        state.camera.set_pose(pose);
        state.display = display;
        state.update_picture();
        renderer.upload(state, palette);
    };
    try {
        if (request_.kind == FilmKind::turn) {
            state.camera.set_pose(turned(state.camera, pose, static_cast<double>(frame - 1) / request_.n_frames));
        } else {
            const double part = std::max(kNearRest, pulled_part(frame, request_.n_frames));
            const auto [low, high] = state.shown.field_range(display);
            state.display.deformation_scale *= part;
            state.display.auto_range = false;
            state.display.range_low = low / part;
            state.display.range_high = high / part;
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
    try {
        draw(renderer, state, palette, frame);
    } catch (...) {
        state.pictures_under_way.reset();
        throw;
    }
    state.pictures_under_way = PictureProgress{frame, request_.n_frames};
    if (frame == request_.n_frames) return finish(state);
    next_ = frame + 1;
}

void Film::finish(ViewerState& state) {
    state.pictures_under_way.reset();
    state.messages.note("Saved " + std::to_string(request_.n_frames) + " frames, " +
                        frame_file(request_.file, 1).string() + " and on");
    if (request_.video)
        video_.start(
            [file = request_.file](Control& control) { return "Saved " + make_video(file, control).string(); });
}

void Film::stop() {
    next_ = 0;
    video_.cancel();
}

bool Film::poll(ViewerState& state) { return tell_end(video_, state.messages); }

}  // namespace elastolab
