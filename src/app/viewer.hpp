#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>

#include "app/files/scene_io.hpp"
#include "app/settings.hpp"
#include "base/control.hpp"

namespace elastolab {

/// How the viewer is started.
struct ViewerOptions {
    std::filesystem::path input;                    ///< scene or mesh; empty: the default scene
    AskedFor asked;                                 ///< instead of the scene's own
    int n_frames = 0;                               ///< quit after so many; 0: when the person closes the window
    std::filesystem::path screenshot;               ///< of the last frame; empty: none
    std::filesystem::path timings, replay, record;  ///< likewise
    std::filesystem::path timeline;                 ///< of the start (StartTimeline); empty: none
    std::filesystem::path scene_out, mesh_out;  ///< likewise: the scene and the deformed mesh as they are at the end
    std::filesystem::path series;               ///< of the replay: a .pvd for ParaView; needs `replay`
    std::filesystem::path picture;              ///< likewise: of the scene alone, or the frames of a film
    Eigen::Vector2i picture_size{1920, 1080};
    bool transparent = false;
    bool legend = false;  ///< and with the colour bar
    int film_frames = 0;  ///< 0: a single picture
    FilmKind film = FilmKind::turn;
    std::optional<Eigen::Vector2i> size;  ///< of the window [logical pixels]
    bool hidden = false;
};

/// Opens the viewer and returns when it is closed. When a number of frames is asked for, the first half is drawn as
/// they come, the rest (and every frame of a replay) once the scene is ready, so that they show and measure it.
/// Throws Error when there is no display, when an output cannot be written, or when the input cannot be read and
/// nobody is there to see it (hidden, or with a number of frames).
/// After a cancel of `control`, by a thread that then calls wake_viewer(), throws Cancelled within a frame: nothing is
/// asked, and of the outputs only `timings` and `record` are written, as far as they go.
void run_viewer(const ViewerOptions& options, Control& control);
/// The same for callers that never cancel.
void run_viewer(const ViewerOptions& options);

/// Makes a viewer that sleeps look whether it was cancelled. Any thread may call it; without a viewer it does nothing.
void wake_viewer();

}  // namespace elastolab
