#pragma once

#include <Eigen/Core>

#include "render/camera.hpp"
#include "render/gl/shader.hpp"
#include "render/scene_frame.hpp"
#include "render/viewport.hpp"

namespace elastolab {

/// What a drawing knows of the camera in one frame. Eye coordinates are in units of the camera's scene radius. Pixels
/// are of the framebuffer: `pixel_ratio` of them make a logical one, and all sizes in styles are multiplied by it.
class SceneView {
public:
    SceneView(const Camera& camera, const Viewport& viewport, double pixel_ratio = 1.0);

    /// From the coordinates of a drawing in this frame to eye coordinates.
    Eigen::Matrix4f model_view(const SceneFrame& frame) const;
    const Eigen::Matrix4f& projection() const { return projection_; }
    /// Width and height of the picture [framebuffer pixels].
    const Eigen::Vector2f& size() const { return size_; }
    float pixel_ratio() const { return pixel_ratio_; }
    /// How near the eye is, over how near it is in perspective.
    float nearness() const { return nearness_; }

    /// Sets the uniforms that every shader has: model_view, projection, picture_size, pixel_slope and up.
    void set_uniforms(ShaderProgram& shader, const SceneFrame& frame) const;

private:
    SceneFrame unit_;
    Eigen::Matrix3d to_eye_;
    Eigen::Vector3d eye_;
    Eigen::Matrix4f projection_;
    Eigen::Vector2f size_;
    float pixel_ratio_, pixel_slope_, nearness_;
    Eigen::Vector3f up_;
};

}  // namespace elastolab
