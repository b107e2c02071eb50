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

struct Arrow {
    Eigen::Vector3d from = Eigen::Vector3d::Zero();     ///< its tail [L]
    Eigen::Vector3d vector = Eigen::Vector3d::UnitX();  ///< from the tail to the tip [L]; none is drawn for zero
    Colour colour;
};

struct ArrowStyle {
    float width = 5.0f;           ///< diameter of the shaft at its middle [logical pixels]
    float hidden_opacity = 0.0f;  ///< of parts behind surfaces, relative; 0: not drawn
};

/// Lit arrows of a round shaft and a cone. Their width on the screen is constant; one shorter than its head is drawn
/// smaller as a whole. Draw them after the opaque surfaces.
class ArrowsDrawing {
public:
    ArrowsDrawing();
    void update(std::span<const Arrow> arrows, const SceneFrame& frame);
    void draw(const SceneView& view, const ArrowStyle& style);

private:
    int n_arrows_ = 0, n_vertices_ = 0;
    GlBuffer shape_, arrows_;
    GlVertexArray array_;
    std::shared_ptr<ShaderProgram> shader_;
    SceneFrame frame_;
};

}  // namespace elastolab
