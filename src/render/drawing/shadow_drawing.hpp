#pragma once

#include <memory>

#include "render/drawing/surface_drawing.hpp"
#include "render/gl/framebuffer.hpp"
#include "render/gl/shader.hpp"

namespace elastolab {

/// The soft shadow of a body on the plane below it: dark where the body is near. GroundDrawing draws it.
class ShadowDrawing {
public:
    ShadowDrawing();
    /// Draws the shadow of `body` on the plane with unit normal `up` through the centre of `area`, up to its radius.
    /// Another framebuffer is bound afterwards: bind the one to draw to.
    void update(const SurfaceDrawing& body, const SceneFrame& area, const Eigen::Vector3d& up);
    unsigned texture() const { return blurred_[1].texture(); }

private:
    MaskBuffer shade_, blurred_[2];
    GlVertexArray array_;
    std::shared_ptr<ShaderProgram> shade_shader_, blur_shader_;
};

}  // namespace elastolab
