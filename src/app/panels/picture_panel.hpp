#pragma once

#include <string>

#include "app/viewer_requests.hpp"

namespace elastolab {

struct PanelContext;
class FileQuestions;

/// Asks for size and kind of a picture or film of the scene, then for its name, and shows how far a film is.
class PicturePanel {
public:
    /// The question is asked in the next frame.
    void ask() { asks_ = true; }
    void draw(const PanelContext& context, FileQuestions& files);

private:
    void draw_question(const PanelContext& context, FileQuestions& files);
    void draw_progress(const PanelContext& context);

    PictureRequest picture_;
    bool asks_ = false;
    std::string video_obstacle_;  ///< why there can be no video
};

}  // namespace elastolab
