#include "render/scene_view.hpp"

#include <cmath>

namespace elastolab {

SceneView::SceneView(const Camera& camera, const Viewport& viewport, double pixel_ratio)
    : unit_(camera.scene()),
      to_eye_(camera.pose().orientation.conjugate().toRotationMatrix()),
      eye_(camera.eye()),
      projection_(camera.projection(viewport, unit_.radius).cast<float>()),
      size_(Eigen::Vector2d(viewport.width * pixel_ratio, viewport.height * pixel_ratio).cast<float>()),
      pixel_ratio_(static_cast<float>(pixel_ratio)),
      pixel_slope_(static_cast<float>(camera.pixel_size(1.0, viewport) / pixel_ratio)),
      nearness_(static_cast<float>(1.0 / camera.remoteness())),
      up_((to_eye_ * camera.up_axis()).cast<float>()) {}

Eigen::Matrix4f SceneView::model_view(const SceneFrame& frame) const {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    matrix.topLeftCorner<3, 3>() = to_eye_ * (frame.radius / unit_.radius);
    matrix.topRightCorner<3, 1>() = to_eye_ * ((frame.center - eye_) / unit_.radius);
    return matrix.cast<float>();
}

void SceneView::set_uniforms(ShaderProgram& shader, const SceneFrame& frame) const {
    shader.set("model_view", model_view(frame));
    shader.set("projection", projection_);
    shader.set("picture_size", size_);
    shader.set("pixel_slope", pixel_slope_);
    shader.set("up", up_);
}

}  // namespace elastolab
