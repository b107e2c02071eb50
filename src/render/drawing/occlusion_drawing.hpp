#pragma once

#include <memory>

#include "render/gl/framebuffer.hpp"
#include "render/gl/shader.hpp"
#include "render/scene_view.hpp"

namespace elastolab {

struct OcclusionStyle {
    double reach = 0.3;  ///< how far away what covers a point may be, in scene radii
    double strength = 0.7;
};

/// Ambient occlusion: darkens hollows and where surfaces meet, by the depths of the picture. Its cost depends on the
/// picture's size alone: a quarter of the pixels that a surface covers are sampled 14 times.
class OcclusionDrawing {
public:
    OcclusionDrawing();
    /// Darkens what was drawn to `target`, which stays bound: after the opaque surfaces, before all else.
    void draw(const SceneView& view, const Framebuffer& target, const OcclusionStyle& style = {});
    /// The same on a tile: as it would be in the whole picture, whose depths are gathered already.
    void draw_tile(const SceneView& view, const Framebuffer& tile, const DepthBuffer& whole,
                   const OcclusionStyle& style = {});

private:
    /// The depths of a picture, and which part of it is drawn [pixels from its bottom left corner].
    struct Part {
        unsigned depths;
        Eigen::Vector2i whole, place, size;
    };
    void draw_part(const SceneView& view, const Framebuffer& target, const Part& part, const OcclusionStyle& style);

    MaskBuffer open_;
    GlVertexArray array_;
    std::shared_ptr<ShaderProgram> find_, blend_;
};

}  // namespace elastolab
