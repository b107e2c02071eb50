#pragma once

#include <memory>
#include <vector>

#include "app/examples.hpp"
#include "render/gl/picture_texture.hpp"

namespace elastolab {

class ViewerState;

/// The scenes that come with the program, as pictures in a menu.
class ExamplesPanel {
public:
    void draw(ViewerState& state, float scale);

private:
    struct ShownExample {
        Example example;
        std::unique_ptr<PictureTexture> picture;  ///< null when there is none
    };
    void load();

    std::vector<ShownExample> examples_;
    bool loaded_ = false;
};

}  // namespace elastolab
