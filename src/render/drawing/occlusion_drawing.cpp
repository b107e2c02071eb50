#include "render/drawing/occlusion_drawing.hpp"

#include <epoxy/gl.h>

#include <algorithm>

namespace elastolab {

namespace {

constexpr int kDepthUnit = 0, kOpenUnit = 1;  // of textures

void draw_screen(const GlVertexArray& array, const GlState& state) {
    apply(state);
    glBindVertexArray(array.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
}

}  // namespace

OcclusionDrawing::OcclusionDrawing()
    : open_(MaskBuffer::Depth::none),
      array_(make_gl_vertex_array()),
      find_(shared_shader({"screen.vert", "occlusion.frag"})),
      blend_(shared_shader({"screen.vert", "occlusion_blend.frag"})) {}

void OcclusionDrawing::draw(const SceneView& view, const Framebuffer& target, const OcclusionStyle& style) {
    target.resolve_depth();
    glActiveTexture(GL_TEXTURE0 + kOpenUnit);
    open_.bind(std::max(1, target.width() / 2), std::max(1, target.height() / 2), 1.0f);
    glBindTexture(GL_TEXTURE_2D, open_.texture());
    glActiveTexture(GL_TEXTURE0 + kDepthUnit);
    glBindTexture(GL_TEXTURE_2D, target.depth_texture());
    for (ShaderProgram* shader : {find_.get(), blend_.get()}) {
        shader->use();
        shader->set("depths", kDepthUnit);
        shader->set("occlusion", kOpenUnit);
        shader->set("projection", view.projection());
        shader->set("reach", static_cast<float>(style.reach));
        shader->set("strength", static_cast<float>(style.strength));
        if (shader == blend_.get()) target.bind();
        draw_screen(array_, {.blend = shader == blend_.get(), .depth = GlState::Depth::ignored, .write_depth = false});
    }
}

}  // namespace elastolab
