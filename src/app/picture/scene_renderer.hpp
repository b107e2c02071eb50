#pragma once

#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "app/picture/body_drawing.hpp"
#include "app/picture/drawing_detail.hpp"
#include "app/picture/look.hpp"
#include "app/picture/palette.hpp"
#include "app/viewer_state.hpp"
#include "render/drawing/axes_gizmo.hpp"
#include "render/drawing/background_drawing.hpp"
#include "render/drawing/ground_drawing.hpp"
#include "render/drawing/occlusion_drawing.hpp"
#include "render/drawing/shadow_drawing.hpp"
#include "render/drawing/surface_drawing.hpp"
#include "render/gl/framebuffer.hpp"

namespace elastolab {

/// The scene on the graphics card: hands over what changed and draws the viewports. Needs a current OpenGL context.
class SceneRenderer {
public:
    SceneRenderer();

    /// Hands vertex data to OpenGL, as far as it has changed.
    void upload(const ViewerState& state, const Palette& palette);
    /// Draws the viewports whose look has changed since they were last drawn; `pixel_ratio` framebuffer pixels make one
    /// logical pixel. Returns how many were drawn.
    int draw(const ViewerState& state, const Palette& palette, double pixel_ratio) {
        return draw(state, palette, pixel_ratio, {});
    }
    /// The same with this detail.
    int draw(const ViewerState& state, const Palette& palette, double pixel_ratio, const DrawingDetail& detail);
    /// Whether a viewport looks otherwise than when it was last drawn, whatever the detail.
    bool has_moved(const ViewerState& state, const Palette& palette, double pixel_ratio) const;
    /// Copies the drawn viewports to the window of this size [framebuffer pixels], and the colour of borders beside
    /// them.
    void show(const ViewerState& state, const Palette& palette, double pixel_ratio, const Eigen::Vector2i& framebuffer);

    /// Draws one viewport without the axes to `target`, which is bound. A tile has ambient occlusion where the depths
    /// of the whole are given, which draw_depths() has gathered from all tiles.
    void draw_plain(const ViewerState& state, const SceneViewport& viewport, const Palette& palette, double pixel_ratio,
                    const Framebuffer& target, const DepthBuffer* whole = nullptr) {
        draw_viewport(state, viewport, palette, pixel_ratio, target, {.axes = false, .whole = whole});
    }
    /// Draws what ambient occlusion depends on to a tile, which is bound, and adds its depths to those of the whole.
    void draw_depths(const ViewerState& state, const SceneViewport& viewport, const Palette& palette,
                     double pixel_ratio, const Framebuffer& tile, DepthBuffer& whole);

    /// How often the marks at the bodies were put together, of all methods of this scene.
    int n_mark_updates() const;

private:
    struct Picture {
        Look look;
        int samples = 0;  ///< that were asked for
        std::unique_ptr<Framebuffer> framebuffer;
    };
    struct Extent {
        bool axes = true;
        const DepthBuffer* whole = nullptr;  ///< the depths of the whole that a tile belongs to
        DrawingDetail detail = {};
    };
    BodyDrawing& drawing(MethodKind kind);
    void draw_viewport(const ViewerState& state, const SceneViewport& viewport, const Palette& palette,
                       double pixel_ratio, const Framebuffer& target, const Extent& extent);
    void draw_solid(const ViewerState& state, const SceneView& view, MethodKind solid, const Palette& palette,
                    const DrawingDetail& detail = {});
    void draw_ground(const ViewerState& state, const SceneView& view, const Palette& palette,
                     const SurfaceDrawing& body, const Framebuffer& target, bool soft_shadows);
    void draw_filling(const ViewerState& state, const SceneView& view, MethodKind kind, const Palette& palette);
    void draw_ghosts(const ViewerState& state, const SceneView& view, const SceneViewport& viewport,
                     const Palette& palette, const DrawingDetail& detail);
    SurfaceStyle surface_style(const ViewerState& state, MethodKind kind, const Palette& palette) const;

    std::uint64_t scene_number_ = 0;
    SceneFrame frame_;
    SurfaceRim rim_;
    std::map<MethodKind, BodyDrawing> drawings_;
    std::vector<Picture> pictures_;  ///< of the viewports, in their order
    std::optional<SurfaceDrawing> rest_;
    BackgroundDrawing background_;
    GroundDrawing ground_;
    OcclusionDrawing occlusion_;
    ShadowDrawing shadow_;
    std::optional<AxesGizmo> gizmo_;
    const Palette* gizmo_palette_ = nullptr;
    const SurfaceMesh* mesh_ = nullptr;
};

/// Of what closes the holes of what is simulated: faint, so that the surface is still seen to be open; less so where it
/// has the colours of a field.
float filling_opacity(const ViewerState& state, MethodKind kind);

}  // namespace elastolab
