#pragma once

#include <Eigen/Core>
#include <memory>

#include "render/colour.hpp"
#include "render/gl/gl_object.hpp"
#include "render/gl/shader.hpp"
#include "render/scene_frame.hpp"
#include "render/scene_view.hpp"

namespace elastolab {

struct GroundStyle {
    Colour line{0.5f, 0.5f, 0.5f, 0.5f};
    double spacing = 0.1;                            ///< of the lines [L]; every fifth is stronger. See round_step().
    unsigned shadow = 0;                             ///< texture of a ShadowDrawing; 0: none
    double shadow_part = 1.0, shadow_opacity = 0.4;  ///< its radius over the area's, and how dark it is
};

/// A grid on a plane that fades out, and the shadow of a body.
class GroundDrawing {
public:
    GroundDrawing();
    /// The axes of the plane with this unit normal, along its grid's lines, as columns.
    static Eigen::Matrix<double, 3, 2> axes(const Eigen::Vector3d& normal);
    /// On the plane with this unit normal through the centre of `area`, gone at its radius. Draw it after the opaque
    /// surfaces.
    void draw(const SceneView& view, const SceneFrame& area, const Eigen::Vector3d& normal, const GroundStyle& style);

private:
    GlVertexArray array_;
    std::shared_ptr<ShaderProgram> shader_;
};

}  // namespace elastolab
