#pragma once

#include <functional>
#include <optional>

#include "app/picture/film.hpp"
#include "app/viewer.hpp"
#include "app/viewer_state.hpp"
#include "app/window/window.hpp"
#include "render/gl/image.hpp"

namespace elastolab {

/// Takes the pictures that a person or the command line asks for: of the window, of the scene alone, and films. All
/// members are for the thread of the window.
class Pictures {
public:
    /// `wake` is called by a worker when poll() will find something.
    explicit Pictures(const std::function<void()>& wake) : film_(wake) {}

    /// The window just drawn, where the person asked for a picture of it; what went wrong becomes a message.
    void take_of_window(ViewerState& state, const Window& window);
    /// Keeps the window just drawn as the screenshot of the command line.
    void keep_last(const Window& window);
    const std::optional<Image>& last() const { return last_; }
    /// Pictures of the scene that the person asked for, and one frame of a film; what went wrong becomes a message.
    /// The window's framebuffer is bound afterwards.
    void take_of_scene(SceneRenderer& renderer, ViewerState& state, const Palette& palette, const Window& window);
    /// The picture or the whole film that the command line asks for; nothing where it asks for none. Throws Error.
    void take_at_end(const ViewerOptions& options, SceneRenderer& renderer, ViewerState& state, const Palette& palette);

    /// Frames of a film are still to be drawn.
    bool filming() const { return film_.running(); }
    /// What the next one shows is being computed.
    bool waiting() const { return film_.waiting(); }
    /// Takes over what the worker finished. Whether there is something new to see.
    bool poll(ViewerState& state) { return film_.poll(state); }
    void stop(ViewerState& state) { film_.stop(state); }
    bool working() const { return film_.working(); }

private:
    void take(const PictureRequest& request, SceneRenderer& renderer, ViewerState& state, const Palette& palette);

    Film film_;
    std::optional<Image> last_;
};

}  // namespace elastolab
