#include "app/picture/scene_renderer.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/drawing/legend.hpp"

namespace elastolab {

namespace {

constexpr double kGroundPart = 3.0, kShadowPart = 1.4;  ///< radii of the ground and of the shadow, of the scene's
constexpr double kLeastDeformation = 0.01;              ///< of the scene's radius, from which a ghost is drawn

/// The edges at which a surface is not closed. Where they are thousands, as of a soup, they would hide the body.
LineStyle rim_style(Eigen::Index n_edges, const Palette& palette) {
    constexpr Eigen::Index kMany = 1000;
    if (n_edges > kMany) return {.colour = palette.bad.with_opacity(0.35f), .width = 1.0f};
    return {.colour = palette.bad, .width = 1.8f, .hidden_opacity = 0.25f};
}

}  // namespace

float filling_opacity(const ViewerState& state, MethodKind kind) {
    const ShownBody* shown = state.shown.body(kind);
    return shown != nullptr && shown->is_coloured() ? 0.85f : 0.10f;
}

SceneRenderer::SceneRenderer() = default;

BodyDrawing& SceneRenderer::drawing(MethodKind kind) { return drawings_.try_emplace(kind, *mesh_, rim_).first->second; }

void SceneRenderer::upload(const ViewerState& state, const Palette& palette) {
    if (scene_number_ != state.scene_number()) {
        scene_number_ = state.scene_number();
        mesh_ = &state.scene().mesh();
        drawings_.clear();
        frame_ = frame_of(mesh_->vertices);
        rim_ = rim_of(mesh_->triangles);
        rest_.emplace(mesh_->vertices, mesh_->triangles);
        rest_->update(mesh_->vertices, frame_);
    }
    if (gizmo_palette_ != &palette) {
        gizmo_palette_ = &palette;
        gizmo_.emplace(palette.axes);
    }
    for (const ShownBody& body : state.shown.bodies()) {
        BodyDrawing& target = drawing(body.kind());
        target.update(body, rim_, frame_);
        target.marks.update(state, body, palette, frame_);
    }
}

SurfaceStyle SceneRenderer::surface_style(const ViewerState& state, MethodKind kind, const Palette& palette) const {
    const DisplaySettings& display = state.display;
    SurfaceStyle style;
    style.colour = palette.body(kind);
    style.flat = display.flat;
    style.material = display.material;
    style.wireframe = display.wireframe;
    style.wire = style.feature = palette.wire;
    style.wire_opacity = 0.28f;
    style.feature_edges = display.feature_edges;
    style.feature_opacity = 0.55f;
    style.colour_map = &shown_colour_map(display);
    const ColourScale scale = state.shown.field_scale(state.display);
    style.low = scale.even(scale.low);
    style.high = scale.even(scale.high);
    style.logarithmic = scale.logarithmic;
    style.contour_bands = display.bands ? kColourBands : 0;
    if (display.field != Field::none) style.light = 0.75f;
    return style;
}

void SceneRenderer::draw_ground(const ViewerState& state, const SceneView& view, const Palette& palette,
                                const SurfaceDrawing& body, const Framebuffer& target, bool soft_shadows) {
    const Eigen::Vector3d up = state.camera.up_axis();
    const double floor = (up.transpose() * mesh_->vertices).minCoeff();
    SceneFrame area = frame_;
    area.center += up * (floor - up.dot(frame_.center) - 1e-3 * frame_.radius);
    GroundStyle style{.line = palette.grid.with_opacity(state.display.grid ? 0.30f : 0.0f),
                      .spacing = round_step(frame_.radius / 8.0)};
    if (soft_shadows) {
        area.radius *= kShadowPart;
        shadow_.update(body, area, up);
        target.bind();
        area.radius /= kShadowPart;
        style.shadow = shadow_.texture();
        style.shadow_part = kShadowPart / kGroundPart;
        style.shadow_opacity = state.display.dark ? 0.75 : 0.35;
    }
    area.radius *= kGroundPart;
    ground_.draw(view, area, up, style);
}

/// What closes the holes of what is simulated.
void SceneRenderer::draw_filling(const ViewerState& state, const SceneView& view, MethodKind kind,
                                 const Palette& palette) {
    BodyDrawing& body = drawing(kind);
    if (!state.display.defects || !body.filling) return;
    SurfaceStyle style = surface_style(state, kind, palette);
    style.colour = palette.bad;  // as the rims of the holes
    style.opacity = filling_opacity(state, kind);
    style.feature_edges = false;
    style.wireframe = state.display.wireframe;
    style.wire = palette.bad;
    style.wire_opacity = 0.40f;
    body.filling->draw(view, style);
}

/// The other methods of a comparison, and the body as it was: seen where they are apart from the solid one.
void SceneRenderer::draw_ghosts(const ViewerState& state, const SceneView& view, const SceneViewport& viewport,
                                const Palette& palette, const DrawingDetail& detail) {
    SurfaceStyle style;
    style.ghost = true;
    style.coarse = !detail.all_triangles;
    if (style.coarse) style.inside = style.inside.with_opacity(0.0f);  // its folds would look like holes
    style.feature_edges = state.display.feature_edges;
    style.feature_width = 1.2f;
    const bool has_field = state.display.field != Field::none;
    const ShownBody* shown = state.shown.body(viewport.kinds.front());
    if (state.display.rest_shape && detail.wireframe && shown != nullptr && !shown->section() &&
        shown->max_displacement() * state.display.deformation_scale > kLeastDeformation * frame_.radius) {
        style.colour = style.inside = style.feature = palette.text_dim;
        style.opacity = has_field ? 0.0f : 0.10f;  // an outline that leaves the colours of the data as they are
        style.feature_opacity = 2.5f;
        rest_->draw(view, style);
    }
    for (std::size_t i = 1; i < viewport.kinds.size(); ++i) {
        style.colour = style.inside = style.feature = palette.body(viewport.kinds[i]);
        style.opacity = 0.45f;
        style.feature_opacity = 1.5f;
        style.plain = true;  // in the colour of its method, which no legend explains otherwise
        drawing(viewport.kinds[i]).seen().draw(view, style);
    }
}

/// The opaque body, whole or cut open.
void SceneRenderer::draw_solid(const ViewerState& state, const SceneView& view, MethodKind solid,
                               const Palette& palette, const DrawingDetail& detail) {
    SurfaceStyle style = surface_style(state, solid, palette);
    if (!detail.wireframe) style.wireframe = style.feature_edges = false;
    style.coarse = !detail.all_triangles;
    if (style.coarse) style.inside = style.inside.with_opacity(0.0f);  // its folds would look like holes
    drawing(solid).seen().draw(view, style);
}

void SceneRenderer::draw_depths(const ViewerState& state, const SceneViewport& viewport, const Palette& palette,
                                double pixel_ratio, const Framebuffer& tile, DepthBuffer& whole) {
    background_.draw(palette.background_top, palette.background_bottom);
    draw_solid(state, SceneView(state.camera, viewport.place, pixel_ratio), viewport.kinds.front(), palette);
    whole.take(tile);
}

void SceneRenderer::draw_viewport(const ViewerState& state, const SceneViewport& viewport, const Palette& palette,
                                  double pixel_ratio, const Framebuffer& target, const Extent& extent) {
    const SceneView view(state.camera, viewport.place, pixel_ratio);
    BodyDrawing& main = drawing(viewport.kinds.front());
    const bool soft_shadows = state.display.soft_shadows && extent.detail.soft_shadows;
    background_.draw(palette.background_top, palette.background_bottom);
    // The ground is behind the body, however it lies: a shadow over it would change the colours of its field.
    if (state.display.grid || soft_shadows) draw_ground(state, view, palette, main.seen(), target, soft_shadows);
    draw_solid(state, view, viewport.kinds.front(), palette, extent.detail);
    if (soft_shadows && extent.whole != nullptr) occlusion_.draw_tile(view, target, *extent.whole);
    if (soft_shadows && !target.is_tile()) occlusion_.draw(view, target);
    main.marks.draw_areas(view);
    draw_filling(state, view, viewport.kinds.front(), palette);
    draw_ghosts(state, view, viewport, palette, extent.detail);
    if (state.display.defects && main.rim) main.rim->draw(view, rim_style(rim_.edges.cols(), palette));
    main.marks.draw(view, mesh_->n_vertices(), palette);
    if (extent.axes) gizmo_->draw(state.camera, viewport.place, AxesGizmo::place_in(viewport.place), pixel_ratio);
}

bool SceneRenderer::has_moved(const ViewerState& state, const Palette& palette, double pixel_ratio) const {
    if (pictures_.size() != state.shown.viewports.size()) return true;
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
        Look look = look_of(state, state.shown.viewports[i], palette, pixel_ratio);
        look.detail = pictures_[i].look.detail;
        if (look != pictures_[i].look) return true;
    }
    return false;
}

int SceneRenderer::n_mark_updates() const {
    int sum = 0;
    for (const auto& [kind, drawing] : drawings_) sum += drawing.marks.n_updates();
    return sum;
}

int SceneRenderer::draw(const ViewerState& state, const Palette& palette, double pixel_ratio,
                        const DrawingDetail& detail) {
    int n_drawn = 0;
    pictures_.resize(state.shown.viewports.size());
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
        const SceneViewport& viewport = state.shown.viewports[i];
        Picture& picture = pictures_[i];
        Look look = look_of(state, viewport, palette, pixel_ratio);
        look.detail = detail;
        if (picture.framebuffer && look == picture.look) continue;
        picture.look = std::move(look);
        const double ratio = pixel_ratio * detail.resolution;
        const int width = std::max(1, static_cast<int>(std::lround(viewport.place.width * ratio)));
        const int height = std::max(1, static_cast<int>(std::lround(viewport.place.height * ratio)));
        if (!picture.framebuffer || picture.samples != detail.samples)
            picture.framebuffer = std::make_unique<Framebuffer>(width, height, detail.samples);
        picture.samples = detail.samples;
        picture.framebuffer->resize(width, height);
        picture.framebuffer->bind();
        draw_viewport(state, viewport, palette, ratio, *picture.framebuffer, {.detail = detail});
        picture.framebuffer->resolve();  // once, not in every frame that shows it
        ++n_drawn;
    }
    return n_drawn;
}

void SceneRenderer::show(const ViewerState& state, const Palette& palette, double pixel_ratio,
                         const Eigen::Vector2i& framebuffer) {
    bind_window(framebuffer.x(), framebuffer.y());
    glClearColor(palette.border.r, palette.border.g, palette.border.b, 1.0f);  // between the viewports
    glClear(GL_COLOR_BUFFER_BIT);
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
        const Viewport& place = state.shown.viewports[i].place;
        const int x = static_cast<int>(std::lround(place.x * pixel_ratio));
        const int y = framebuffer.y() - static_cast<int>(std::lround((place.y + place.height) * pixel_ratio));
        pictures_[i].framebuffer->copy_to_window(x, y, static_cast<int>(std::lround(place.width * pixel_ratio)),
                                                 static_cast<int>(std::lround(place.height * pixel_ratio)));
    }
    bind_window(framebuffer.x(), framebuffer.y());
}

}  // namespace elastolab
