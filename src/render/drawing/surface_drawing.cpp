#include "render/drawing/surface_drawing.hpp"

#include <epoxy/gl.h>

#include <cassert>
#include <cstddef>
#include <vector>

#include "render/geometry/coarse_surface.hpp"

namespace elastolab {

namespace {

constexpr unsigned kPosition = 0, kNormal = 1, kScalar = 2;  // locations in surface.vert
constexpr int kMapUnit = 0, kTriangleUnit = 1;               // of textures

/// Opacity that the edges of an outline are of, whose faces have none.
constexpr float kShareOfOutline = 0.14f;
/// How far a ghost is pushed away from the eye, over its distance, so that it does not flicker where it touches others.
constexpr float kGhostPush = 0.004f;

void upload_map(const GlTexture& texture, const ColourMap& map) {
    std::vector<Colour> texels;
    for (const Colour& colour : map.table()) texels.push_back(linear(colour));
    glBindTexture(GL_TEXTURE_2D, texture.id());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA16F, ColourMap::kEntries, 1, 0, GL_RGBA, GL_FLOAT, texels.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

}  // namespace

SurfaceDrawing::SurfaceDrawing(const PositionsView& rest, const TrianglesView& triangles)
    : geometry_(rest, triangles),
      n_indices_(static_cast<int>(triangles.size())),
      vertices_(make_gl_buffer()),
      indices_(make_gl_buffer()),
      vertex_scalars_(make_gl_buffer()),
      triangle_scalars_(make_gl_buffer()),
      map_texture_(make_gl_texture()),
      triangle_texture_(make_gl_texture()),
      array_(make_gl_vertex_array()),
      features_(geometry_.groups().features, vertices_, sizeof(DrawnVertex)),
      shader_(shared_shader({"surface.vert", "surface.geom", "surface.frag"})) {
    Eigen::Matrix3Xi corners = geometry_.groups().corners;
    if (triangles.cols() > 2 * kFewTriangles) {
        const Eigen::Matrix3Xi few = coarse_corners(rest, triangles, geometry_.groups(), kFewTriangles);
        n_coarse_ = static_cast<int>(few.size());
        corners.conservativeResize(Eigen::NoChange, corners.cols() + few.cols());
        corners.rightCols(few.cols()) = few;
    }
    upload(indices_, std::span<const int>(corners.data(), static_cast<std::size_t>(corners.size())));
    attach_all();
    set_triangle_scalars({});
    clear_scalars();
    update(rest, frame_of(rest));
}

void SurfaceDrawing::attach_all() {
    constexpr std::size_t kStride = sizeof(DrawnVertex);
    attach_indices(array_, indices_);
    attach(array_, vertices_, {.location = kPosition, .offset = offsetof(DrawnVertex, position), .stride = kStride});
    attach(array_, vertices_, {.location = kNormal, .offset = offsetof(DrawnVertex, normal), .stride = kStride});
    attach(array_, vertex_scalars_, {.location = kScalar, .components = 1, .stride = sizeof(float)});
}

void SurfaceDrawing::update(const PositionsView& positions, const SceneFrame& frame) {
    geometry_.update(positions, frame);
    upload(vertices_, geometry_.vertices());
    frame_ = frame;
}

void SurfaceDrawing::set_vertex_scalars(std::span<const float> values) {
    std::vector<float> drawn;
    for (const int vertex : geometry_.groups().vertices) drawn.push_back(values[static_cast<std::size_t>(vertex)]);
    upload(vertex_scalars_, std::span<const float>(drawn));
    scalars_ = Scalars::per_vertex;
}

void SurfaceDrawing::set_triangle_scalars(std::span<const float> values) {
    assert(values.empty() || static_cast<int>(values.size()) * 3 == n_indices_);
    upload(triangle_scalars_, values);
    glBindTexture(GL_TEXTURE_BUFFER, triangle_texture_.id());
    glTexBuffer(GL_TEXTURE_BUFFER, GL_R32F, triangle_scalars_.id());
    scalars_ = Scalars::per_triangle;
}

void SurfaceDrawing::set_uniforms(const SceneView& view, const SurfaceStyle& style) {
    view.set_uniforms(*shader_, frame_);
    shader_->set("colour", linear(style.colour));
    shader_->set("inside", linear(style.inside));
    shader_->set("opacity", style.opacity);
    shader_->set("push", view.nearness() * (style.ghost ? kGhostPush : style.overlay ? -kGhostPush : 0.0f));
    shader_->set("light", style.light);
    shader_->set("material", static_cast<int>(style.material));
    shader_->set("flat_normals", style.flat ? 1 : 0);
    shader_->set("wire", style.wire.with_opacity(style.wireframe ? style.wire_opacity : 0.0f));
    shader_->set("wire_width", style.wire_width * view.pixel_ratio());
    shader_->set("scalar_source", static_cast<int>(style.plain ? Scalars::none : scalars_));
    const double range = style.high - style.low;
    shader_->set("scalar_scale", range > 0.0 ? static_cast<float>(1.0 / range) : 0.0f);
    shader_->set("scalar_log", style.logarithmic ? 1 : 0);
    shader_->set("scalar_low", static_cast<float>(style.low));
    shader_->set("scalar_offset", range > 0.0 ? 0.0f : 0.5f);
    shader_->set("contour_bands", static_cast<float>(style.contour_bands));
    shader_->set("colour_map", kMapUnit);
    shader_->set("triangle_scalars", kTriangleUnit);
}

void SurfaceDrawing::bind_textures(const SurfaceStyle& style) {
    const ColourMap* const map = style.colour_map != nullptr ? style.colour_map : &colour_maps().front();
    glActiveTexture(GL_TEXTURE0 + kTriangleUnit);
    glBindTexture(GL_TEXTURE_BUFFER, triangle_texture_.id());
    glActiveTexture(GL_TEXTURE0 + kMapUnit);
    if (map != shown_map_) upload_map(map_texture_, *map);
    shown_map_ = map;
    glBindTexture(GL_TEXTURE_2D, map_texture_.id());
}

void SurfaceDrawing::draw_triangles(const GlState& state, bool coarse) const {
    apply(state);
    glBindVertexArray(array_.id());
    if (scalars_ != Scalars::per_vertex) glDisableVertexAttribArray(kScalar);
    if (scalars_ == Scalars::per_vertex) glEnableVertexAttribArray(kScalar);
    const auto behind = static_cast<std::size_t>(n_indices_) * sizeof(int);
    if (coarse)
        // An offset into the buffer, which OpenGL takes as a pointer.
        glDrawElements(GL_TRIANGLES, n_coarse_, GL_UNSIGNED_INT, reinterpret_cast<const void*>(behind));
    else
        glDrawElements(GL_TRIANGLES, n_indices_, GL_UNSIGNED_INT, nullptr);
    glBindVertexArray(0);
}

void SurfaceDrawing::draw_shape() const {
    apply({});
    glBindVertexArray(array_.id());
    glDrawElements(GL_TRIANGLES, n_indices_, GL_UNSIGNED_INT, nullptr);
    glBindVertexArray(0);
}

void SurfaceDrawing::draw(const SceneView& view, const SurfaceStyle& style) {
    shader_->use();
    set_uniforms(view, style);
    bind_textures(style);
    const bool coarse = style.coarse && n_coarse_ > 0 && (style.plain || scalars_ != Scalars::per_triangle);
    if (style.ghost) {
        draw_triangles({.blend = true, .write_depth = false, .cull = GlState::Cull::front}, coarse);
        draw_triangles({.blend = true, .write_depth = false, .cull = GlState::Cull::back}, coarse);
    } else if (style.overlay) {
        draw_triangles({.blend = true, .write_depth = false, .cull = GlState::Cull::back}, coarse);
    } else if (style.opacity < 1.0f) {
        draw_triangles({.blend = true, .write_depth = false, .cull = GlState::Cull::front}, coarse);
        draw_triangles({.blend = true, .cull = GlState::Cull::back}, coarse);
    } else {
        draw_triangles({}, coarse);
    }
    if (!style.feature_edges) return;
    const float share = style.opacity > 0.0f ? style.opacity : kShareOfOutline;
    const Colour colour = style.feature.with_opacity(style.feature_opacity * share);
    features_.draw(view, frame_, {.colour = colour, .width = style.feature_width});
}

}  // namespace elastolab
