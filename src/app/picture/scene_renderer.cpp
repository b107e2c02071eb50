#include "app/picture/scene_renderer.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/drawing/legend.hpp"

namespace elastolab {

namespace {

constexpr double kArrowPart = 0.3;   ///< length of the longest reaction arrow, of the scene's radius
constexpr double kGizmoSize = 72.0;  ///< [logical pixels]
constexpr float kPointSize = 6.0f, kActivePointSize = 8.0f, kHoverPointSize = 7.0f;
constexpr int kBands = 10;
constexpr double kFullView = 800.0;  ///< width from which on points have their full size [logical pixels]

/// Points grow smaller when a mesh is so fine that they would cover it.
float crowd_factor(int n_vertices) { return n_vertices > 3000 ? 0.65f : n_vertices > 1500 ? 0.8f : 1.0f; }

/// And in small views.
float view_factor(const ViewerState& state) {
    const double width = state.shown.viewports.empty() ? kFullView : state.shown.viewports.front().place.width;
    return static_cast<float>(std::clamp(width / kFullView, 0.6, 1.0));
}

void add_points(std::span<const int> vertices, const Positions& x, const Colour& colour, float size,
                std::vector<PointSprite>& points) {
    for (const int v : vertices) points.push_back({x.col(v), colour, size});
}

}  // namespace

Viewport gizmo_place(const Viewport& viewport) {
    return {viewport.x + 8.0, viewport.y + viewport.height - kGizmoSize - 8.0, kGizmoSize, kGizmoSize};
}

SceneRenderer::SceneRenderer() = default;

SceneRenderer::BodyDrawing& SceneRenderer::drawing(MethodKind kind) {
    const auto found = drawings_.find(kind);
    if (found != drawings_.end()) return found->second;
    return drawings_.try_emplace(kind, *mesh_, edges_).first->second;
}

void SceneRenderer::upload(const ViewerState& state, const Palette& palette) {
    if (scene_number_ != state.scene_number()) {
        scene_number_ = state.scene_number();
        mesh_ = &state.scene().mesh();
        drawings_.clear();
        edges_ = edges_of(mesh_->triangles);
        frame_ = frame_of(mesh_->vertices);
        rest_.emplace(edges_);
        rest_->update(mesh_->vertices, frame_);
    }
    if (gizmo_palette_ != &palette) {
        gizmo_palette_ = &palette;
        gizmo_.emplace(palette.axes);
    }
    for (const ShownBody& body : state.shown.bodies()) upload_body(state, body, palette);
}

void SceneRenderer::upload_body(const ViewerState& state, const ShownBody& body, const Palette& palette) {
    BodyDrawing& target = drawing(body.kind());
    const bool is_new = target.revision != body.revision();
    if (is_new) {
        target.revision = body.revision();
        target.surface.update(body.positions(), frame_);
        if (body.values().empty())
            target.surface.clear_scalars();
        else
            target.surface.set_vertex_scalars(body.values());
        upload_section(body, target);
    }
    if (is_new || target.palette != &palette) {
        target.palette = &palette;
        upload_arrows(state, body, target, palette);
    }
    if (state.compare.mode == CompareMode::ghosts && target.ghost_revision != body.revision()) {
        target.ghost_revision = body.revision();
        target.ghost.update(body.positions(), frame_);
    }
    upload_points(state, body, target, palette);
}

void SceneRenderer::upload_section(const ShownBody& body, BodyDrawing& target) {
    if (!body.section()) {
        target.section.reset();
        return;
    }
    const ShownSection& section = *body.section();
    if (!target.section || target.section_shape != section.shape) {
        target.section.emplace(section.shape->rest(), section.shape->triangles());
        target.section_shape = section.shape;
    }
    target.section->update(section.positions, frame_);
    if (section.values.empty())
        target.section->clear_scalars();
    else
        target.section->set_vertex_scalars(section.values);
}

void SceneRenderer::upload_points(const ViewerState& state, const ShownBody& body, BodyDrawing& target,
                                  const Palette& palette) {
    const LiveScene& scene = state.scene();
    const float crowd = crowd_factor(scene.mesh().n_vertices()) * view_factor(state);
    std::vector<PointSprite> points;
    if (state.display.constraints) {
        add_points(scene.vertices(LiveScene::kFixed), body.positions(), palette.fixed, crowd * kPointSize, points);
        for (int h = 0; h < scene.n_handles(); ++h) {
            const bool active = h == state.gestures.selected_handle();
            add_points(scene.vertices(h), body.positions(), active ? palette.active : palette.handle,
                       crowd * (active ? kActivePointSize : kPointSize), points);
        }
    }
    const Hover& hover = state.gestures.hover();
    if (!state.gestures.pulling()) {
        add_points(hover.patch, body.positions(), palette.hover, crowd * kHoverPointSize, points);
        if (hover.vertex >= 0)
            points.push_back({body.positions().col(hover.vertex), palette.hover, kHoverPointSize + 3.0f});
    }
    target.points.update(points, frame_);
}

void SceneRenderer::upload_arrows(const ViewerState& state, const ShownBody& body, BodyDrawing& target,
                                  const Palette& palette) {
    std::vector<Arrow> arrows;
    double largest = 0.0;
    for (const ShownReaction& reaction : body.reactions()) largest = std::max(largest, reaction.force.norm());
    if (state.display.arrows && largest > 0.0)
        for (const ShownReaction& reaction : body.reactions()) {
            const Eigen::Vector3d vector = kArrowPart * frame_.radius / largest * reaction.force;
            arrows.push_back({reaction.place, vector, reaction.name == "fixed" ? palette.fixed : palette.handle});
        }
    target.arrows.update(arrows, frame_);
}

SurfaceStyle SceneRenderer::surface_style(const ViewerState& state, MethodKind kind, const Palette& palette) const {
    const DisplaySettings& display = state.display;
    SurfaceStyle style;
    style.colour = palette.body(kind);
    style.flat = display.flat;
    style.wireframe = display.wireframe;
    style.wire = style.feature = palette.wire;
    style.wire_opacity = 0.28f;
    style.feature_edges = display.feature_edges;
    style.feature_opacity = 0.55f;
    style.colour_map = &colour_map(display.colour_map);
    std::tie(style.low, style.high) = state.shown.field_range(state.display);
    style.contour_bands = display.bands ? kBands : 0;
    if (display.field != Field::none) style.light = 0.75f;
    return style;
}

void SceneRenderer::draw_ground(const ViewerState& state, const SceneView& view, const Palette& palette) {
    const Eigen::Vector3d up = state.camera.up_axis();
    const double floor = (up.transpose() * mesh_->vertices).minCoeff();
    SceneFrame area = frame_;
    area.center += up * (floor - up.dot(frame_.center) - 1e-3 * frame_.radius);
    area.radius *= 3.0;
    ground_.draw(view, area, up, {palette.grid.with_opacity(0.30f), round_step(frame_.radius / 8.0)});
}

void SceneRenderer::draw_viewport(const ViewerState& state, const SceneViewport& viewport, const Palette& palette,
                                  double pixel_ratio) {
    const SceneView view(state.camera, viewport.place, pixel_ratio);
    const MethodKind solid = viewport.kinds.front();
    background_.draw(palette.background_top, palette.background_bottom);
    BodyDrawing& main = drawing(solid);
    const SurfaceStyle style = surface_style(state, solid, palette);
    (main.section ? *main.section : main.surface).draw(view, style);
    if (state.display.grid) draw_ground(state, view, palette);
    if (state.display.rest_shape)
        rest_->draw(view, {.colour = palette.text_dim.with_opacity(0.5f), .width = 1.0f, .hidden_opacity = 0.4f});
    for (std::size_t i = 1; i < viewport.kinds.size(); ++i)
        drawing(viewport.kinds[i])
            .ghost.draw(
                view,
                {.colour = palette.body(viewport.kinds[i]).with_opacity(0.9f), .width = 1.3f, .hidden_opacity = 0.25f});
    main.points.draw(view, {.outline = palette.wire, .outline_width = 1.0f, .hidden_opacity = 0.12f});
    main.arrows.draw(view, {.width = 6.0f, .hidden_opacity = 0.5f});
    gizmo_->draw(state.camera, viewport.place, gizmo_place(viewport.place), pixel_ratio);
}

SceneRenderer::Look SceneRenderer::look_of(const ViewerState& state, const SceneViewport& viewport,
                                           const Palette& palette, double pixel_ratio) const {
    Look look;
    look.kinds = viewport.kinds;
    for (const MethodKind kind : viewport.kinds)
        look.body_revisions.push_back(state.shown.body(kind) != nullptr ? state.shown.body(kind)->revision() : 0);
    const CameraPose& pose = state.camera.pose();
    look.camera_target = pose.target;
    look.camera_turn = pose.orientation.coeffs();
    look.camera_up = state.camera.up_axis();
    look.camera_scene = state.camera.scene().center;
    look.camera_distance = pose.distance;
    look.pixel_ratio = pixel_ratio;
    look.width = viewport.place.width;
    look.height = viewport.place.height;
    look.display = state.display;
    look.range = state.shown.field_range(state.display);
    look.hover = state.gestures.hover();
    look.selected_handle = state.gestures.selected_handle();
    look.pulling = state.gestures.pulling();
    look.scene_number = state.scene_number();
    look.scene_revision = state.scene().revision();
    look.palette = &palette;
    return look;
}

int SceneRenderer::draw(const ViewerState& state, const Palette& palette, double pixel_ratio) {
    int n_drawn = 0;
    pictures_.resize(state.shown.viewports.size());
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
        const SceneViewport& viewport = state.shown.viewports[i];
        Picture& picture = pictures_[i];
        Look look = look_of(state, viewport, palette, pixel_ratio);
        if (picture.framebuffer && look == picture.look) continue;
        picture.look = std::move(look);
        const int width = std::max(1, static_cast<int>(std::lround(viewport.place.width * pixel_ratio)));
        const int height = std::max(1, static_cast<int>(std::lround(viewport.place.height * pixel_ratio)));
        if (!picture.framebuffer) picture.framebuffer = std::make_unique<Framebuffer>(width, height);
        picture.framebuffer->resize(width, height);
        picture.framebuffer->bind();
        draw_viewport(state, viewport, palette, pixel_ratio);
        ++n_drawn;
    }
    return n_drawn;
}

void SceneRenderer::show(const ViewerState& state, double pixel_ratio, const Eigen::Vector2i& framebuffer) {
    bind_window(framebuffer.x(), framebuffer.y());
    glClearColor(0.0f, 0.0f, 0.0f, 1.0f);  // between the viewports
    glClear(GL_COLOR_BUFFER_BIT);
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
        const Viewport& place = state.shown.viewports[i].place;
        const int x = static_cast<int>(std::lround(place.x * pixel_ratio));
        const int y = framebuffer.y() - static_cast<int>(std::lround((place.y + place.height) * pixel_ratio));
        pictures_[i].framebuffer->copy_to_window(x, y);
    }
    bind_window(framebuffer.x(), framebuffer.y());
}

}  // namespace elastolab
