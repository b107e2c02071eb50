#include "render/drawing/points_drawing.hpp"

#include <epoxy/gl.h>

#include <cstddef>
#include <vector>

#include "render/packed_colour.hpp"

namespace elastolab {

namespace {

/// As the graphics card gets it.
struct PackedPoint {
    Eigen::Vector3f position;
    float size;
    PackedColour colour;
};

}  // namespace

PointsDrawing::PointsDrawing()
    : points_(make_gl_buffer()), array_(make_gl_vertex_array()), shader_(shared_shader({"point.vert", "point.frag"})) {
    upload(points_, std::span<const PackedPoint>());
    constexpr std::size_t kStride = sizeof(PackedPoint);
    attach(array_, points_,
           {.location = 0, .components = 3, .offset = offsetof(PackedPoint, position), .stride = kStride});
    attach(array_, points_, {.location = 1, .components = 1, .offset = offsetof(PackedPoint, size), .stride = kStride});
    attach(array_, points_,
           {.location = 2, .components = 4, .offset = offsetof(PackedPoint, colour), .stride = kStride, .bytes = true});
}

void PointsDrawing::update(std::span<const PointSprite> points, const SceneFrame& frame) {
    std::vector<PackedPoint> packed;
    packed.reserve(points.size());
    for (const PointSprite& point : points)
        packed.push_back({frame.local(point.position), point.size, pack(point.colour)});
    upload(points_, std::span<const PackedPoint>(packed));
    n_points_ = static_cast<int>(points.size());
    frame_ = frame;
}

void PointsDrawing::draw(const SceneView& view, const PointStyle& style) {
    if (n_points_ == 0) return;
    shader_->use();
    view.set_uniforms(*shader_, frame_);
    shader_->set("pixel_ratio", view.pixel_ratio());
    shader_->set("outline", style.outline);
    shader_->set("outline_width", style.outline_width * view.pixel_ratio());
    glBindVertexArray(array_.id());
    const auto pass = [&](GlState::Depth depth, bool write_depth, float opacity) {
        apply({.blend = true, .depth = depth, .write_depth = write_depth});
        shader_->set("opacity", opacity);
        glDrawArrays(GL_POINTS, 0, n_points_);
    };
    if (style.hidden_opacity > 0.0f) pass(GlState::Depth::behind, false, style.hidden_opacity);
    pass(GlState::Depth::nearer_or_equal, true, 1.0f);
    glBindVertexArray(0);
}

}  // namespace elastolab
