#include "render/drawing/lines_drawing.hpp"

#include <epoxy/gl.h>

namespace elastolab {

EdgeBatch::EdgeBatch(const Edges& edges, const GlBuffer& positions, std::size_t stride)
    : n_indices_(static_cast<int>(edges.size())),
      indices_(make_gl_buffer()),
      array_(make_gl_vertex_array()),
      shader_(shared_shader({"line.vert", "line.geom", "line.frag"})) {
    upload(indices_, std::span(edges.data(), static_cast<std::size_t>(edges.size())));
    attach_indices(array_, indices_);
    attach(array_, positions, {.location = 0, .components = 3, .stride = stride});
}

void EdgeBatch::draw(const SceneView& view, const SceneFrame& frame, const LineStyle& style) {
    if (n_indices_ == 0) return;
    shader_->use();
    view.set_uniforms(*shader_, frame);
    shader_->set("width", style.width * view.pixel_ratio());
    glBindVertexArray(array_.id());
    const auto pass = [&](GlState::Depth depth, float opacity) {
        apply({.blend = true, .depth = depth, .write_depth = false});
        shader_->set("colour", style.colour.with_opacity(style.colour.a * opacity));
        glDrawElements(GL_LINES, n_indices_, GL_UNSIGNED_INT, nullptr);
    };
    if (style.hidden_opacity > 0.0f) pass(GlState::Depth::behind, style.hidden_opacity);
    pass(GlState::Depth::nearer_or_equal, 1.0f);
    glBindVertexArray(0);
}

LinesDrawing::LinesDrawing(const Edges& edges)
    : positions_(make_gl_buffer()), edges_(edges, positions_, 3 * sizeof(float)) {
    upload(positions_, std::span<const float>());
}

void LinesDrawing::update(const PositionsView& positions, const SceneFrame& frame) {
    const Eigen::Matrix3Xf local = ((positions.colwise() - frame.center) / frame.radius).cast<float>();
    upload(positions_, std::span(local.data(), static_cast<std::size_t>(local.size())));
    frame_ = frame;
}

void LinesDrawing::draw(const SceneView& view, const LineStyle& style) { edges_.draw(view, frame_, style); }

}  // namespace elastolab
