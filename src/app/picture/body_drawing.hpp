#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "app/picture/body_marks.hpp"
#include "app/picture/shown_body.hpp"
#include "render/drawing/lines_drawing.hpp"
#include "render/drawing/surface_drawing.hpp"

namespace elastolab {

/// The edges at which a surface is not closed.
struct SurfaceRim {
    Edges edges;                ///< numbers in the list that follows
    std::vector<int> vertices;  ///< of the surface, ascending
};
SurfaceRim rim_of(const Triangles& triangles);

/// One method's body on the graphics card: whole or cut open, the rims and the filling of its holes, its marks. Needs a
/// current OpenGL context.
class BodyDrawing {
public:
    BodyDrawing(const SurfaceMesh& mesh, const SurfaceRim& rim_of_surface);

    /// Hands over what the body has that is not on the card yet, but for the marks.
    void update(const ShownBody& body, const SurfaceRim& rim_of_surface, const SceneFrame& frame);

    SurfaceDrawing surface;
    std::optional<SurfaceDrawing> section;  ///< where it is cut open
    std::optional<LinesDrawing> rim;        ///< where the surface is not closed
    std::optional<SurfaceDrawing> filling;  ///< of its holes; of what is left of them where it is cut open
    BodyMarks marks;

    /// What is seen of the surface.
    SurfaceDrawing& seen() { return section ? *section : surface; }

private:
    void update_section(const ShownBody& body, const SceneFrame& frame);
    void update_filling(const ShownBody& body, const SceneFrame& frame);

    std::shared_ptr<const SectionShape> section_shape_;
    std::shared_ptr<const void> filling_shape_;  ///< whose triangles it has: of the filling, or of the section
    std::uint64_t revision_ = 0;                 ///< of the body that is on the card
};

}  // namespace elastolab
