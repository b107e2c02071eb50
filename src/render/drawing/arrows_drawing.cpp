#include "render/drawing/arrows_drawing.hpp"

#include <epoxy/gl.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "render/packed_colour.hpp"

namespace elastolab {

namespace {

constexpr int kSides = 24;
/// Length of the head / its radius; arrow.vert has the same number.
constexpr float kHeadSlope = 2.6f;

/// A vertex of the arrow. Its distance from the axis and its place along it are sums of lengths that arrow.vert knows.
struct ShapeVertex {
    float cosine, sine;
    float shaft_radii, head_radii;  ///< distance from the axis: so many of each radius
    float necks, lengths;           ///< place along the axis: so many shafts and whole arrows
    float outward, forward;         ///< normal
};

/// A ring of the profile: all that does not depend on the angle.
struct Ring {
    float shaft_radii, head_radii, necks, lengths;
};

struct ArrowInstance {
    Eigen::Vector3f from, vector;
    PackedColour colour;
};

ShapeVertex on_ring(const Ring& ring, int side, float outward, float forward) {
    const float angle = 2.0f * std::numbers::pi_v<float> * static_cast<float>(side) / kSides;
    return {std::cos(angle), std::sin(angle), ring.shaft_radii, ring.head_radii,
            ring.necks,      ring.lengths,    outward,          forward};
}

/// The band between two rings, with one normal along the profile.
void add_band(std::vector<ShapeVertex>& shape, const Ring& a, const Ring& b, float outward, float forward) {
    for (int side = 0; side < kSides; ++side) {
        const auto corner = [&](const Ring& ring, int s) { return on_ring(ring, s, outward, forward); };
        for (const ShapeVertex& vertex : {corner(a, side), corner(a, side + 1), corner(b, side + 1), corner(a, side),
                                          corner(b, side + 1), corner(b, side)})
            shape.push_back(vertex);
    }
}

std::vector<ShapeVertex> arrow_shape() {
    const Ring tail_axis{0, 0, 0, 0}, tail{1, 0, 0, 0}, neck{1, 0, 1, 0}, flange{0, 1, 1, 0}, tip{0, 0, 0, 1};
    const float norm = std::hypot(kHeadSlope, 1.0f);
    std::vector<ShapeVertex> shape;
    add_band(shape, tail_axis, tail, 0.0f, -1.0f);
    add_band(shape, tail, neck, 1.0f, 0.0f);
    add_band(shape, neck, flange, 0.0f, -1.0f);
    add_band(shape, flange, tip, kHeadSlope / norm, 1.0f / norm);
    return shape;
}

void attach_shape(const GlVertexArray& array, const GlBuffer& shape) {
    constexpr std::size_t kStride = sizeof(ShapeVertex);
    attach(array, shape, {.location = 0, .components = 2, .offset = 0, .stride = kStride});
    attach(array, shape,
           {.location = 1, .components = 4, .offset = offsetof(ShapeVertex, shaft_radii), .stride = kStride});
    attach(array, shape, {.location = 2, .components = 2, .offset = offsetof(ShapeVertex, outward), .stride = kStride});
}

void attach_instances(const GlVertexArray& array, const GlBuffer& arrows) {
    GlAttribute attribute{.location = 3, .components = 3, .stride = sizeof(ArrowInstance), .per_instance = true};
    attach(array, arrows, attribute);
    attribute.location = 4;
    attribute.offset = offsetof(ArrowInstance, vector);
    attach(array, arrows, attribute);
    attribute.location = 5;
    attribute.offset = offsetof(ArrowInstance, colour);
    attribute.components = 4;
    attribute.bytes = true;
    attach(array, arrows, attribute);
}

}  // namespace

ArrowsDrawing::ArrowsDrawing()
    : shape_(make_gl_buffer()),
      arrows_(make_gl_buffer()),
      array_(make_gl_vertex_array()),
      shader_(shared_shader({"arrow.vert", "arrow.frag"})) {
    const std::vector<ShapeVertex> shape = arrow_shape();
    upload(shape_, std::span<const ShapeVertex>(shape));
    upload(arrows_, std::span<const ArrowInstance>());
    n_vertices_ = static_cast<int>(shape.size());
    attach_shape(array_, shape_);
    attach_instances(array_, arrows_);
}

void ArrowsDrawing::update(std::span<const Arrow> arrows, const SceneFrame& frame) {
    std::vector<ArrowInstance> instances;
    instances.reserve(arrows.size());
    for (const Arrow& arrow : arrows)
        if (!arrow.vector.isZero(0.0))
            instances.push_back(
                {frame.local(arrow.from), (arrow.vector / frame.radius).cast<float>(), pack(arrow.colour)});
    upload(arrows_, std::span<const ArrowInstance>(instances));
    n_arrows_ = static_cast<int>(instances.size());
    frame_ = frame;
}

void ArrowsDrawing::draw(const SceneView& view, const ArrowStyle& style) {
    if (n_arrows_ == 0) return;
    shader_->use();
    view.set_uniforms(*shader_, frame_);
    shader_->set("width", style.width * view.pixel_ratio());
    glBindVertexArray(array_.id());
    const auto pass = [&](GlState::Depth depth, bool opaque, float opacity) {
        apply({.blend = !opaque, .depth = depth, .write_depth = opaque, .cull = GlState::Cull::back});
        shader_->set("opacity", opacity);
        glDrawArraysInstanced(GL_TRIANGLES, 0, n_vertices_, n_arrows_);
    };
    if (style.hidden_opacity > 0.0f) pass(GlState::Depth::behind, false, style.hidden_opacity);
    pass(GlState::Depth::nearer_or_equal, true, 1.0f);
    glBindVertexArray(0);
}

}  // namespace elastolab
