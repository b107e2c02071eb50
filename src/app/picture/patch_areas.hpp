#pragma once

#include <memory>
#include <span>
#include <vector>

#include "mesh/surface_mesh.hpp"
#include "render/colour.hpp"
#include "render/drawing/lines_drawing.hpp"
#include "render/drawing/surface_drawing.hpp"

namespace elastolab {

/// Fixed sets, handles and loads of so many vertices that dots at them would hide the body: tinted areas of it with a
/// line around each. Needs a current OpenGL context.
class PatchAreas {
public:
    /// Up to so many vertices a patch is shown by dots.
    static constexpr std::size_t kMostDots = 300;

    /// A set of vertices (ascending or not, each once), its colour, and how much of it is seen inside the outline.
    struct Patch {
        std::span<const int> vertices;
        Colour colour;
        float tint = 0.38f;
    };
    /// Shows these patches of the mesh at these positions (of its vertices). Returns for each whether it is an area;
    /// the others are too small, or have no triangle, and are left to dots. moved: positions are others than before.
    std::vector<char> update(const SurfaceMesh& mesh, const Positions& positions, const SceneFrame& frame,
                             std::span<const Patch> patches, bool moved);
    /// Over the body, which is drawn already.
    void draw(const SceneView& view);

private:
    struct Area {
        std::vector<int> vertices;  ///< as they were asked for
        std::vector<int> corners;   ///< those of its triangles, ascending
        Colour colour;
        float tint = 0.0f;
        std::unique_ptr<SurfaceDrawing> surface;
        std::unique_ptr<LinesDrawing> outline;
    };
    static std::unique_ptr<Area> make(const SurfaceMesh& mesh, std::span<const int> vertices);

    std::vector<std::unique_ptr<Area>> areas_;
};

}  // namespace elastolab
