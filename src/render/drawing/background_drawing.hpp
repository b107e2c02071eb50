#pragma once

#include <memory>

#include "render/colour.hpp"
#include "render/gl/gl_object.hpp"
#include "render/gl/shader.hpp"

namespace elastolab {

/// A vertical gradient behind everything, without visible steps.
class BackgroundDrawing {
public:
    BackgroundDrawing();
    /// Clears the picture, colours and depth. First in every frame.
    void draw(const Colour& top, const Colour& bottom);

private:
    GlVertexArray array_;
    std::shared_ptr<ShaderProgram> shader_;
};

}  // namespace elastolab
