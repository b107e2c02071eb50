#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>

#include "render/colour.hpp"
#include "render/gl/gl_object.hpp"
#include "render/gl/shader.hpp"
#include "render/scene_frame.hpp"
#include "render/scene_view.hpp"

namespace elastolab {

/// One point: a disc of constant size on the screen.
struct PointSprite {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Colour colour;
    float size = 8.0f;  ///< diameter without the outline [logical pixels]
};

struct PointStyle {
    Colour outline{1.0f, 1.0f, 1.0f, 1.0f};
    float outline_width = 1.5f;   ///< [logical pixels]; 0: none
    float hidden_opacity = 0.0f;  ///< of points behind surfaces, relative; 0: not drawn
};

/// Round, outlined, antialiased points, slightly domed. They are drawn nearer to the eye by about their radius, so that
/// the surface that they lie on does not cut them. Draw them after the surfaces and lines.
class PointsDrawing {
public:
    PointsDrawing();
    void update(std::span<const PointSprite> points, const SceneFrame& frame);
    void draw(const SceneView& view, const PointStyle& style);

private:
    int n_points_ = 0;
    GlBuffer points_;
    GlVertexArray array_;
    std::shared_ptr<ShaderProgram> shader_;
    SceneFrame frame_;
};

}  // namespace elastolab
