#include "render/drawing/shadow_drawing.hpp"

#include <epoxy/gl.h>

#include "render/drawing/ground_drawing.hpp"

namespace elastolab {

namespace {

constexpr int kTexels = 256;  ///< along a side of the shadow's picture

}  // namespace

ShadowDrawing::ShadowDrawing()
    : shade_(MaskBuffer::Depth::tested),
      blurred_{MaskBuffer(MaskBuffer::Depth::none), MaskBuffer(MaskBuffer::Depth::none)},
      array_(make_gl_vertex_array()),
      shade_shader_(shared_shader({"shadow.vert", "shadow.frag"})),
      blur_shader_(shared_shader({"screen.vert", "blur.frag"})) {}

void ShadowDrawing::update(const SurfaceDrawing& body, const SceneFrame& area, const Eigen::Vector3d& up) {
    Eigen::Matrix3d axes;
    axes << GroundDrawing::axes(up), up;
    Eigen::Matrix4d onto_ground = Eigen::Matrix4d::Identity();
    onto_ground.topLeftCorner<3, 3>() = axes.transpose() * (body.frame().radius / area.radius);
    onto_ground.topRightCorner<3, 1>() = axes.transpose() * (body.frame().center - area.center) / area.radius;
    shade_.bind(kTexels, kTexels, 0.0f);
    shade_shader_->use();
    shade_shader_->set("onto_ground", Eigen::Matrix4f(onto_ground.cast<float>()));
    body.draw_shape();
    blur_shader_->use();
    blur_shader_->set("picture", 0);
    for (int axis = 0; axis < 2; ++axis) {
        blurred_[axis].bind(kTexels, kTexels, 0.0f);
        glActiveTexture(GL_TEXTURE0);
        glBindTexture(GL_TEXTURE_2D, axis == 0 ? shade_.texture() : blurred_[0].texture());
        blur_shader_->set("step", Eigen::Vector2f(axis == 0 ? 1.0f : 0.0f, axis == 0 ? 0.0f : 1.0f));
        apply({.depth = GlState::Depth::ignored, .write_depth = false});
        glBindVertexArray(array_.id());
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glBindVertexArray(0);
    }
}

}  // namespace elastolab
