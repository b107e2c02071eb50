#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>

#include "app/settings.hpp"

namespace elastolab {

/// A picture of the scene alone, or the frames of a film of it.
struct PictureRequest {
    std::filesystem::path file = {};
    Eigen::Vector2i size{1920, 1080};  ///< [pixels]
    bool transparent = false;
    bool legend = true;  ///< with the colour bar, where there is one
    int n_frames = 0;    ///< of a film; 0: a single picture
    FilmKind kind = FilmKind::turn;
    bool video = false;
};
struct PictureProgress {
    int done = 0, wanted = 0;  ///< frames
};

/// What the window and the dialogs are asked to do.
struct ViewerRequests {
    std::optional<std::filesystem::path> screenshot;
    std::optional<PictureRequest> picture;
    bool stop_pictures = false;
    bool quit = false;
};

}  // namespace elastolab
