#include "app/picture/pictures.hpp"

#include <chrono>
#include <thread>
#include <utility>

#include "app/picture/scene_picture.hpp"
#include "app/window/window_picture.hpp"
#include "base/error.hpp"

namespace elastolab {

void Pictures::take_of_window(ViewerState& state, const Window& window) {
    if (!state.requests.screenshot) return;
    const std::filesystem::path file = *std::exchange(state.requests.screenshot, std::nullopt);
    try {
        write_png(file, window_picture(window.framebuffer_size()));
        state.messages.note("Saved " + file.string());
    } catch (const Error& error) {
        state.messages.error(error.what());
    }
}

void Pictures::keep_last(const Window& window) { last_ = window_picture(window.framebuffer_size()); }

void Pictures::take_of_scene(SceneRenderer& renderer, ViewerState& state, const Palette& palette,
                             const Window& window) {
    if (std::exchange(state.requests.stop_pictures, false)) {
        film_.stop(state);
        state.pictures_under_way.reset();
    }
    try {
        if (const auto request = std::exchange(state.requests.picture, std::nullopt))
            take(*request, renderer, state, palette);
        if (film_.running()) film_.step(renderer, state, palette);
    } catch (const std::exception& error) {  // also where there is no memory for it
        state.messages.error(error.what());
    }
    bind_window(window.framebuffer_size().x(), window.framebuffer_size().y());
}

void Pictures::take_at_end(const ViewerOptions& options, SceneRenderer& renderer, ViewerState& state,
                           const Palette& palette) {
    if (options.picture.empty()) return;
    const PictureRequest request{.file = options.picture,
                                 .size = options.picture_size,
                                 .transparent = options.transparent,
                                 .legend = options.legend,
                                 .n_frames = options.film_frames,
                                 .kind = options.film};
    take(request, renderer, state, palette);
    while (film_.running()) {
        film_.step(renderer, state, palette);
        if (film_.waiting()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

void Pictures::take(const PictureRequest& request, SceneRenderer& renderer, ViewerState& state,
                    const Palette& palette) {
    if (request.n_frames > 0) return film_.start(request);
    write_picture(request.file, renderer, state, palette, request.size,
                  {request.transparent, request.legend ? legend_of(state) : std::nullopt});
    state.messages.note("Saved " + request.file.string());
}

}  // namespace elastolab
