#include "render/drawing/occlusion_drawing.hpp"

#include <epoxy/gl.h>

#include <algorithm>

namespace elastolab {

namespace {

constexpr int kDepthUnit = 0, kOpenUnit = 1;  // of textures
constexpr int kBlendedCells = 2;              ///< on each side of a pixel's own, that its occlusion is blended from

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
    const Eigen::Vector2i size(target.width(), target.height());
    draw_part(view, target, {target.depth_texture(), size, {0, 0}, size}, style);
}

void OcclusionDrawing::draw_tile(const SceneView& view, const Framebuffer& tile, const DepthBuffer& whole,
                                 const OcclusionStyle& style) {
    draw_part(view, tile,
              {whole.texture(), {whole.width(), whole.height()}, tile.place(), {tile.width(), tile.height()}}, style);
}

void OcclusionDrawing::draw_part(const SceneView& view, const Framebuffer& target, const Part& part,
                                 const OcclusionStyle& style) {
    // Cells of two by two pixels, counted from the corner of the whole picture.
    const Eigen::Vector2i last_of_whole = (part.whole / 2).cwiseMax(1).array() - 1;
    const Eigen::Vector2i first = (part.place / 2).array() - kBlendedCells;
    const Eigen::Vector2i last = (part.place + part.size) / 2 + Eigen::Vector2i::Constant(kBlendedCells);
    const Eigen::Vector2i low = first.cwiseMax(0), high = last.cwiseMin(last_of_whole);
    glActiveTexture(GL_TEXTURE0 + kOpenUnit);
    open_.bind(high.x() - low.x() + 1, high.y() - low.y() + 1, 1.0f);
    glBindTexture(GL_TEXTURE_2D, open_.texture());
    glActiveTexture(GL_TEXTURE0 + kDepthUnit);
    glBindTexture(GL_TEXTURE_2D, part.depths);
    for (ShaderProgram* shader : {find_.get(), blend_.get()}) {
        shader->use();
        shader->set("depths", kDepthUnit);
        shader->set("occlusion", kOpenUnit);
        shader->set("projection", view.projection());
        shader->set("reach", static_cast<float>(style.reach));
        shader->set("strength", static_cast<float>(style.strength));
        shader->set("first_cell", low);
        shader->set("first_pixel", part.place);
        if (shader == blend_.get()) target.bind();
        draw_screen(array_, {.blend = shader == blend_.get(), .depth = GlState::Depth::ignored, .write_depth = false});
    }
}

}  // namespace elastolab
