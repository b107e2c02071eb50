#pragma once

#include <Eigen/Core>
#include <memory>

#include "render/colour.hpp"
#include "render/gl/gl_object.hpp"
#include "render/scene_frame.hpp"
#include "render/scene_view.hpp"
#include "render/gl/shader.hpp"

namespace elastolab {

struct GroundStyle {
    Colour line{0.5f, 0.5f, 0.5f, 0.5f};
    double spacing = 0.1;  ///< of the lines [L]; every fifth is stronger. See round_step().
};

/// A grid on a plane that fades out.
class GroundDrawing {
public:
    GroundDrawing();
    /// Through the centre of `area`, across the unit vector `normal`, and gone at its radius. Draw it after the opaque
    /// surfaces.
    void draw(const SceneView& view, const SceneFrame& area, const Eigen::Vector3d& normal, const GroundStyle& style);

private:
    GlVertexArray array_;
    std::shared_ptr<ShaderProgram> shader_;
};

}  // namespace elastolab
