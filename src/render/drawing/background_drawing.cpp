#include "render/drawing/background_drawing.hpp"

#include <epoxy/gl.h>

namespace elastolab {

BackgroundDrawing::BackgroundDrawing()
    : array_(make_gl_vertex_array()), shader_(shared_shader({"background.vert", "background.frag"})) {}

void BackgroundDrawing::draw(const Colour& top, const Colour& bottom) {
    apply({});
    glClearDepth(1.0);
    glClearColor(bottom.r, bottom.g, bottom.b, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    apply({.depth = GlState::Depth::ignored, .write_depth = false});
    shader_->use();
    shader_->set("top", top);
    shader_->set("bottom", bottom);
    glBindVertexArray(array_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
}

}  // namespace elastolab
