#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/picture/scene_picture.hpp"
#include "scene/live/background_job.hpp"
#include "scene/motion.hpp"

namespace elastolab {

/// "name.png" -> "name-0007.png": the frames count from 1.
std::filesystem::path frame_file(const std::filesystem::path& file, int frame);

/// How far the body is deformed in a frame of a film of the pull, 0 (at rest) to 1 (as it is): there and back,
/// smoothly, so that the film can be repeated without a jump.
double pulled_part(int frame, int n_frames);

/// Whether a part of the pull is what is shown with displacements scaled by that part: every method on the screen is
/// linear, and every handle goes straight.
bool pull_scales(const ViewerState& state);

/// Frames of a film as numbered pictures, one at a time so that the window stays alive, and then, when it is wanted, a
/// video of them made by ffmpeg on a worker. A film of a pull that does not merely scale moves the handles of the scene
/// part of their way for each frame, through their turns, under that part of the loads, and puts them back at its end.
/// All members are for the thread of the window.
class Film {
public:
    /// `wake` is called by the worker when poll() will find something.
    explicit Film(const std::function<void()>& wake) : video_(wake) {}

    void start(const PictureRequest& request) {
        request_ = request;
        next_ = 1;
    }
    /// Frames are still to be drawn.
    bool running() const { return next_ > 0; }
    /// The answer to the next frame's pull is being computed.
    bool waiting() const { return running() && waiting_; }
    /// Draws and writes the next frame, or, while that is computed, does nothing. Throws Error when it fails or the
    /// scene was changed meanwhile, which ends it.
    void step(SceneRenderer& renderer, ViewerState& state, const Palette& palette);
    void stop(ViewerState& state);
    /// Takes over what the worker finished. Whether there is something new to see.
    bool poll(ViewerState& state);
    bool working() const { return video_.working(); }

private:
    /// Handles and loads on their way: what they were before, and what they are in the present frame.
    struct Pose {
        struct Handle {
            std::string name;
            Motion whole, part;
            std::optional<GripForce> force;  ///< that moved it there; on its way it is led
        };
        struct Load {
            std::string name;
            LoadValue whole, part;
        };
        explicit Pose(const ViewerState& state);
        void put(LiveScene& scene, double part);
        void put_back(LiveScene& scene) const;

        std::vector<Handle> handles;
        std::vector<Load> loads;
        std::optional<Eigen::Vector3d> whole_gravity, gravity;
        std::uint64_t revision = 0;       ///< of the scene, as it was put last
        std::pair<double, double> range;  ///< of the colours, of the whole pull
    };
    bool pose(SceneRenderer& renderer, ViewerState& state, const Palette& palette);
    void put_back(ViewerState& state);
    void draw(SceneRenderer& renderer, ViewerState& state, const Palette& palette, int frame) const;
    void finish(ViewerState& state);

    PictureRequest request_;
    int next_ = 0;                    ///< frame, counted from 1; 0: none
    std::uint64_t scene_number_ = 0;  ///< since the first frame (ViewerState::scene_number)
    bool waiting_ = false;
    std::optional<Pose> pose_;
    BackgroundJob<std::string> video_;  ///< with its note
};

/// The video of a film: "name.png" -> "name.mp4", 30 frames a second, made by the ffmpeg that is installed. It
/// takes its place once it is complete. Throws Error where there is no ffmpeg or it fails, Cancelled.
std::filesystem::path make_video(const std::filesystem::path& file, Control& control);
/// Why no video can be made; empty when one can.
std::string video_obstacle();

}  // namespace elastolab
