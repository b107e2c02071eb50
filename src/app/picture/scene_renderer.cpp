#include "app/picture/scene_renderer.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/picture/load_arrows.hpp"
#include "render/drawing/legend.hpp"

namespace elastolab {

namespace {

constexpr double kArrowPart = 0.3;  ///< length of the longest reaction arrow, of the scene's radius
constexpr float kPointSize = 6.0f, kActivePointSize = 8.0f, kHoverPointSize = 7.0f, kLoadedPointSize = 4.0f;
constexpr float kPatchTint = 0.38f, kLoadTint = 0.12f;  ///< a load may cover all of the body
constexpr int kBands = 10;
constexpr double kGroundPart = 3.0, kShadowPart = 1.4;  ///< radii of the ground and of the shadow, of the scene's
constexpr double kLeastDeformation = 0.01;              ///< of the scene's radius, from which a ghost is drawn
constexpr int kMostHidden = 6000;    ///< vertices up to which points show through the body; more would cover it
constexpr double kFullView = 800.0;  ///< width from which on points have their full size [logical pixels]

/// Points grow smaller when a mesh is so fine that they would cover it.
float crowd_factor(int n_vertices) {
    return n_vertices > 30000 ? 0.4f : n_vertices > 3000 ? 0.65f : n_vertices > 1500 ? 0.8f : 1.0f;
}

/// And in small views.
float view_factor(const ViewerState& state) {
    const double width = state.shown.viewports.empty() ? kFullView : state.shown.viewports.front().place.width;
    return static_cast<float>(std::clamp(width / kFullView, 0.6, 1.0));
}

/// Whether each vertex is seen: where the body is cut open, those of what is left.
std::vector<char> seen_vertices(const ShownBody& body) {
    std::vector<char> seen(static_cast<std::size_t>(body.positions().cols()), body.section() ? 0 : 1);
    if (!body.section()) return seen;
    for (const int v : body.section()->shape->triangles().reshaped())
        if (static_cast<std::size_t>(v) < seen.size()) seen[static_cast<std::size_t>(v)] = 1;
    return seen;
}

/// Each once.
std::vector<int> corners_of(const AppliedLoad& load, const SurfaceMesh& surface) {
    std::vector<int> corners;
    for (const int t : load.triangles)
        for (const int v : surface.triangles.col(t)) corners.push_back(v);
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    return corners;
}

}  // namespace

float filling_opacity(const ViewerState& state, MethodKind kind) {
    const ShownBody* shown = state.shown.body(kind);
    return shown != nullptr && shown->is_coloured() ? 0.85f : 0.10f;
}

SceneRenderer::SceneRenderer() = default;

SceneRenderer::BodyDrawing& SceneRenderer::drawing(MethodKind kind) {
    const auto found = drawings_.find(kind);
    if (found != drawings_.end()) return found->second;
    BodyDrawing& drawing = drawings_.try_emplace(kind, *mesh_).first->second;
    if (rim_.cols() > 0) drawing.rim.emplace(rim_);
    return drawing;
}

void SceneRenderer::upload(const ViewerState& state, const Palette& palette) {
    if (scene_number_ != state.scene_number()) {
        scene_number_ = state.scene_number();
        mesh_ = &state.scene().mesh();
        drawings_.clear();
        frame_ = frame_of(mesh_->vertices);
        find_rim();
        rest_.emplace(mesh_->vertices, mesh_->triangles);
        rest_->update(mesh_->vertices, frame_);
    }
    if (gizmo_palette_ != &palette) {
        gizmo_palette_ = &palette;
        gizmo_.emplace(palette.axes);
    }
    for (const ShownBody& body : state.shown.bodies()) upload_body(state, body, palette);
}

/// The edges at which the surface is not closed, as numbers in the list of the vertices on them.
void SceneRenderer::find_rim() {
    rim_ = unpaired_edges(mesh_->triangles);
    rim_vertices_.assign(rim_.data(), rim_.data() + rim_.size());
    std::sort(rim_vertices_.begin(), rim_vertices_.end());
    rim_vertices_.erase(std::unique(rim_vertices_.begin(), rim_vertices_.end()), rim_vertices_.end());
    for (int& vertex : rim_.reshaped())
        vertex = static_cast<int>(std::lower_bound(rim_vertices_.begin(), rim_vertices_.end(), vertex) -
                                  rim_vertices_.begin());
}

void SceneRenderer::upload_body(const ViewerState& state, const ShownBody& body, const Palette& palette) {
    BodyDrawing& target = drawing(body.kind());
    const bool is_new = target.revision != body.revision();
    if (is_new) {
        target.revision = body.revision();
        upload_surface(body.positions(), body.values(), target.surface);
        if (rim_.cols() > 0) target.rim->update(Positions(body.positions()(Eigen::all, rim_vertices_)), frame_);
        upload_section(body, target);
        upload_filling(body, target);
    }
    upload_arrows(state, body, target, palette);
    upload_patches(state, body, target, palette, is_new);
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
    upload_surface(section.positions, section.values, *target.section);
}

/// Where the body is cut open, what is left of it there.
void SceneRenderer::upload_filling(const ShownBody& body, BodyDrawing& target) {
    if (!body.filling()) return target.filling.reset();
    const std::optional<ShownSection>& section = body.section();
    const ShownFilling& whole = *body.filling();
    const Triangles& triangles = section ? section->shape->filling() : whole.shape->triangles();
    if (triangles.cols() == 0) return target.filling.reset();
    const std::shared_ptr<const void> shape = section ? std::shared_ptr<const void>(section->shape) : whole.shape;
    if (!target.filling || target.filling_shape != shape) {
        target.filling.emplace(section ? section->shape->rest() : whole.shape->rest(), triangles);
        target.filling_shape = shape;
    }
    if (section)
        upload_surface(section->positions, section->values, *target.filling);
    else
        upload_surface(whole.positions, whole.values, *target.filling);
}

void SceneRenderer::upload_surface(const Positions& positions, const std::vector<float>& values,
                                   SurfaceDrawing& target) {
    target.update(positions, frame_);
    if (values.empty())
        target.clear_scalars();
    else
        target.set_vertex_scalars(values);
}

namespace {

/// A fixed set, a handle or the corners of a load, and how large its dots are.
struct ShownPatch {
    std::vector<int> vertices;
    Colour colour;
    float dot_size;
    float tint;  ///< where it is an area
};

std::vector<ShownPatch> shown_patches(const ViewerState& state, const Palette& palette) {
    const LiveScene& scene = state.scene();
    std::vector<ShownPatch> patches;
    const bool has_field = state.display.field != Field::none;  // whose colours stay as they are
    const auto add = [&](std::span<const int> vertices, const Colour& colour, float size, float tint = kPatchTint) {
        patches.push_back({{vertices.begin(), vertices.end()}, colour, size, has_field ? 0.0f : tint});
    };
    for (int s = 0; s < scene.n_fixed_sets(); ++s) {
        const bool active = s == state.gestures.selected_fixed();
        add(scene.fixed_vertices(s), active ? palette.fixed_active : palette.fixed,
            active ? kActivePointSize : kPointSize);
    }
    for (int h = 0; h < scene.n_handles(); ++h) {
        const bool active = h == state.gestures.selected_handle();
        add(scene.vertices(h), active ? palette.active : palette.handle, active ? kActivePointSize : kPointSize);
    }
    for (const AppliedLoad& load : scene.constraints().loads)
        add(corners_of(load, scene.mesh()),
            state.gestures.selected_load() == load.number ? palette.active : palette.load, kLoadedPointSize, kLoadTint);
    return patches;
}

}  // namespace

/// Large ones as areas, and small ones as dots; where the body is cut open, all as dots at what is left of it.
void SceneRenderer::upload_patches(const ViewerState& state, const ShownBody& body, BodyDrawing& target,
                                   const Palette& palette, bool moved) {
    const float crowd = crowd_factor(state.scene().mesh().n_vertices()) * view_factor(state);
    const std::vector<char> seen = seen_vertices(body);
    std::vector<PointSprite> points;
    const auto add_points = [&](std::span<const int> vertices, const Colour& colour, float size) {
        for (const int v : vertices)
            if (seen[static_cast<std::size_t>(v)] != 0) points.push_back({body.positions().col(v), colour, size});
    };
    const std::vector<ShownPatch> patches =
        state.display.constraints ? shown_patches(state, palette) : std::vector<ShownPatch>();
    std::vector<PatchAreas::Patch> areas;
    if (!body.section())
        for (const ShownPatch& patch : patches) areas.push_back({patch.vertices, patch.colour, patch.tint});
    const std::vector<char> is_area = target.areas.update(state.scene().mesh(), body.positions(), frame_, areas, moved);
    for (std::size_t i = 0; i < patches.size(); ++i)
        if (i >= is_area.size() || is_area[i] == 0)
            add_points(patches[i].vertices, patches[i].colour, crowd * patches[i].dot_size);
    const Hover& hover = state.gestures.hover();
    if (!state.gestures.dragging()) {
        add_points(hover.patch, palette.hover, crowd * kHoverPointSize);
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
            arrows.push_back({reaction.place, vector, reaction.fixed ? palette.fixed : palette.handle});
        }
    if (state.display.constraints)
        for (const LoadArrow& load :
             load_arrows(state.scene(), body.positions(), frame_.radius, state.gestures.dragged_load())) {
            const bool active = state.gestures.selected_load() == load.load || state.gestures.hover().load == load.load;
            const Eigen::Vector3d vector = load.end - load.place;
            arrows.push_back({load.inward ? load.end : load.place, load.inward ? Eigen::Vector3d(-vector) : vector,
                              active ? palette.active : palette.load});
        }
    target.arrows.update(arrows, frame_);
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
    style.contour_bands = display.bands ? kBands : 0;
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
        BodyDrawing& ghost = drawing(viewport.kinds[i]);
        (ghost.section ? *ghost.section : ghost.surface).draw(view, style);
    }
}

/// The background, and the opaque body in front of it, whole or cut open.
const SurfaceDrawing& SceneRenderer::draw_solid(const ViewerState& state, const SceneView& view, MethodKind solid,
                                                const Palette& palette, const DrawingDetail& detail) {
    background_.draw(palette.background_top, palette.background_bottom);
    BodyDrawing& main = drawing(solid);
    SurfaceDrawing& body = main.section ? *main.section : main.surface;
    SurfaceStyle style = surface_style(state, solid, palette);
    if (!detail.wireframe) style.wireframe = style.feature_edges = false;
    body.draw(view, style);
    return body;
}

void SceneRenderer::draw_depths(const ViewerState& state, const SceneViewport& viewport, const Palette& palette,
                                double pixel_ratio, const Framebuffer& tile, DepthBuffer& whole) {
    draw_solid(state, SceneView(state.camera, viewport.place, pixel_ratio), viewport.kinds.front(), palette);
    whole.take(tile);
}

void SceneRenderer::draw_viewport(const ViewerState& state, const SceneViewport& viewport, const Palette& palette,
                                  double pixel_ratio, const Framebuffer& target, const Extent& extent) {
    const SceneView view(state.camera, viewport.place, pixel_ratio);
    BodyDrawing& main = drawing(viewport.kinds.front());
    const SurfaceDrawing& body = draw_solid(state, view, viewport.kinds.front(), palette, extent.detail);
    const bool soft_shadows = state.display.soft_shadows && extent.detail.soft_shadows;
    if (soft_shadows && extent.whole != nullptr) occlusion_.draw_tile(view, target, *extent.whole);
    if (soft_shadows && !target.is_tile()) occlusion_.draw(view, target);
    if (state.display.grid || soft_shadows) draw_ground(state, view, palette, body, target, soft_shadows);
    main.areas.draw(view);
    draw_filling(state, view, viewport.kinds.front(), palette);
    draw_ghosts(state, view, viewport, palette, extent.detail);
    if (state.display.defects && main.rim)
        main.rim->draw(view, {.colour = palette.bad, .width = 1.8f, .hidden_opacity = 0.25f});
    const float hidden = mesh_->n_vertices() > kMostHidden ? 0.0f : 0.12f;
    main.points.draw(view, {.outline = palette.wire, .outline_width = 1.0f, .hidden_opacity = hidden});
    main.arrows.draw(view, {.width = 6.0f, .hidden_opacity = 0.5f});
    if (extent.axes) gizmo_->draw(state.camera, viewport.place, AxesGizmo::place_in(viewport.place), pixel_ratio);
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
    look.projection = state.camera.projection_kind();
    look.pixel_ratio = pixel_ratio;
    look.width = viewport.place.width;
    look.height = viewport.place.height;
    look.covered = viewport.place.covered;
    look.display = state.display;
    const ColourScale scale = state.shown.field_scale(state.display);
    look.range = {scale.low, scale.high};
    look.hover = state.gestures.hover();
    look.selected_handle = state.gestures.selected_handle();
    look.selected_fixed = state.gestures.selected_fixed();
    look.pulling = state.gestures.dragging();
    look.selected_load = state.gestures.selected_load();
    look.scene_number = state.scene_number();
    look.scene_revision = state.scene().revision();
    look.palette = &palette;
    return look;
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
        pictures_[i].framebuffer->copy_to_window(x, y, static_cast<int>(std::lround(place.width * pixel_ratio)),
                                                 static_cast<int>(std::lround(place.height * pixel_ratio)));
    }
    bind_window(framebuffer.x(), framebuffer.y());
}

}  // namespace elastolab
