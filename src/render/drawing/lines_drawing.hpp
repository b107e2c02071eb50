#pragma once

#include <memory>

#include "render/colour.hpp"
#include "render/gl/arrays.hpp"
#include "render/gl/gl_object.hpp"
#include "render/gl/shader.hpp"
#include "render/scene_frame.hpp"
#include "render/scene_view.hpp"

namespace elastolab {

struct LineStyle {
    Colour colour{0.2f, 0.2f, 0.2f, 1.0f};
    float width = 1.5f;           ///< [logical pixels]
    float hidden_opacity = 0.0f;  ///< of parts behind surfaces, relative; 0: not drawn
};

/// Segments between vertices of a buffer that someone else fills, as antialiased lines.
class EdgeBatch {
public:
    /// The buffer holds a position as three floats every `stride` bytes.
    EdgeBatch(const Edges& edges, const GlBuffer& positions, std::size_t stride);
    void draw(const SceneView& view, const SceneFrame& frame, const LineStyle& style);

private:
    int n_indices_;
    GlBuffer indices_;
    GlVertexArray array_;
    std::shared_ptr<ShaderProgram> shader_;
};

/// Antialiased lines, such as the rims of holes. They are drawn a pixel or two nearer to the eye than they are, so that
/// they show on a surface that they lie on. Draw them after the surfaces.
class LinesDrawing {
public:
    explicit LinesDrawing(const Edges& edges);
    void update(const PositionsView& positions, const SceneFrame& frame);
    void draw(const SceneView& view, const LineStyle& style);

private:
    GlBuffer positions_;
    EdgeBatch edges_;
    SceneFrame frame_;
};

}  // namespace elastolab
