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
    /// Of `body` on the plane through the centre of `area`, across the unit vector `up`, as far as its radius. Draws
    /// go elsewhere afterwards: bind what is to be drawn to.
    void update(const SurfaceDrawing& body, const SceneFrame& area, const Eigen::Vector3d& up);
    unsigned texture() const { return blurred_[1].texture(); }

private:
    MaskBuffer shade_, blurred_[2];
    GlVertexArray array_;
    std::shared_ptr<ShaderProgram> shade_shader_, blur_shader_;
};

}  // namespace elastolab
