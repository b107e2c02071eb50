#include "app/picture/body_marks.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "mesh/numbering.hpp"

namespace elastolab {

namespace {

constexpr double kArrowPart = 0.3;  ///< length of the longest reaction arrow, of the scene's radius
constexpr float kPointSize = 6.0f, kActivePointSize = 8.0f, kHoverPointSize = 7.0f, kLoadedPointSize = 4.0f;
constexpr float kPatchTint = 0.38f, kHoverTint = 0.2f, kLoadTint = 0.12f;  ///< a load may cover all of the body
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

std::vector<char> seen_vertices(const ShownBody& body) {
    std::vector<char> seen(static_cast<std::size_t>(body.positions().cols()), body.section() ? 0 : 1);
    if (!body.section()) return seen;
    for (const int v : body.section()->shape->triangles().reshaped())
        if (static_cast<std::size_t>(v) < seen.size()) seen[static_cast<std::size_t>(v)] = 1;
    return seen;
}

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
        add(used_vertices(scene.mesh().triangles(Eigen::all, load.triangles)),
            state.gestures.selected_load() == load.number ? palette.active : palette.load, kLoadedPointSize, kLoadTint);
    return patches;
}

void add_dots(const ShownBody& body, std::span<const int> vertices, const std::vector<char>& seen, const Colour& colour,
              float size, std::vector<PointSprite>& points) {
    for (const int v : vertices)
        if (seen[static_cast<std::size_t>(v)] != 0) points.push_back({body.positions().col(v), colour, size});
}

}  // namespace

BodyMarks::Key BodyMarks::key_of(const ViewerState& state, const ShownBody& body, const Palette& palette) {
    const Gestures& gestures = state.gestures;
    return {.scene_revision = state.scene().revision(),
            .body_revision = body.revision(),
            .palette = &palette,
            .constraints = state.display.constraints,
            .arrows = state.display.arrows,
            .has_field = state.display.field != Field::none,
            .selected_fixed = gestures.selected_fixed(),
            .selected_handle = gestures.selected_handle(),
            .selected_load = gestures.selected_load(),
            .dragged = gestures.dragged_load(),
            .size = crowd_factor(state.scene().mesh().n_vertices()) * view_factor(state)};
}

void BodyMarks::update(const ViewerState& state, const ShownBody& body, const Palette& palette,
                       const SceneFrame& frame) {
    const Key key = key_of(state, body, palette);
    const Hover& hover = state.gestures.hover();
    const bool dragging = state.gestures.dragging(), is_new = key_ != key;
    if (!is_new && hover == hover_ && dragging == dragging_) return;
    const bool other_load = hover.load != hover_.load;
    hover_ = hover;
    dragging_ = dragging;
    if (is_new) {
        ++n_updates_;
        update_areas(state, body, key, frame);
    }
    if (is_new || other_load) update_arrows(state, body, key, frame);
    update_hover(state, body, key, frame);
    key_ = key;
}

/// Large patches as areas, and small ones as dots; where the body is cut open, all as dots at what is left of it.
void BodyMarks::update_areas(const ViewerState& state, const ShownBody& body, const Key& key, const SceneFrame& frame) {
    const bool moved = !key_ || key_->body_revision != key.body_revision;
    if (moved) seen_ = seen_vertices(body);
    const std::vector<ShownPatch> patches =
        key.constraints ? shown_patches(state, *key.palette) : std::vector<ShownPatch>();
    std::vector<PatchAreas::Patch> areas;
    if (!body.section())
        for (const ShownPatch& patch : patches) areas.push_back({patch.vertices, patch.colour, patch.tint});
    const std::vector<char> is_area = areas_.update(state.scene().mesh(), body.positions(), frame, areas, moved);
    dots_.clear();
    for (std::size_t i = 0; i < patches.size(); ++i)
        if (i >= is_area.size() || is_area[i] == 0)
            add_dots(body, patches[i].vertices, seen_, patches[i].colour, key.size * patches[i].dot_size, dots_);
}

/// The dots, and where nothing is dragged what the mouse points at: as patches are shown, too.
void BodyMarks::update_hover(const ViewerState& state, const ShownBody& body, const Key& key, const SceneFrame& frame) {
    std::vector<PointSprite> points = dots_;
    const Hover& hover = state.gestures.hover();
    std::vector<PatchAreas::Patch> areas;
    if (!dragging_ && !body.section())
        areas.push_back({hover.patch, key.palette->hover, key.has_field ? 0.0f : kHoverTint});
    const std::vector<char> is_area = hover_area_.update(state.scene().mesh(), body.positions(), frame, areas, true);
    if (!dragging_) {
        if (is_area.empty() || is_area.front() == 0)
            add_dots(body, hover.patch, seen_, key.palette->hover, key.size * kHoverPointSize, points);
        if (hover.vertex >= 0)
            points.push_back({body.positions().col(hover.vertex), key.palette->hover, kHoverPointSize + 3.0f});
    }
    points_.update(points, frame);
}

void BodyMarks::update_arrows(const ViewerState& state, const ShownBody& body, const Key& key,
                              const SceneFrame& frame) {
    const Palette& palette = *key.palette;
    std::vector<Arrow> arrows;
    double largest = 0.0;
    for (const ShownReaction& reaction : body.reactions()) largest = std::max(largest, reaction.force.norm());
    if (key.arrows && largest > 0.0)
        for (const ShownReaction& reaction : body.reactions()) {
            const Eigen::Vector3d vector = kArrowPart * frame.radius / largest * reaction.force;
            arrows.push_back({reaction.place, vector, reaction.fixed ? palette.fixed : palette.handle});
        }
    if (key.constraints)
        for (const LoadArrow& load : state.load_arrows_at(body)) {
            const bool active = key.selected_load == load.load || hover_.load == load.load;
            const Eigen::Vector3d vector = load.end - load.place;
            arrows.push_back({load.inward ? load.end : load.place, load.inward ? Eigen::Vector3d(-vector) : vector,
                              active ? palette.active : palette.load});
        }
    arrows_.update(arrows, frame);
}

void BodyMarks::draw(const SceneView& view, int n_vertices, const Palette& palette) {
    const float hidden = n_vertices > kMostHidden ? 0.0f : 0.12f;
    points_.draw(view, {.outline = palette.wire, .outline_width = 1.0f, .hidden_opacity = hidden});
    arrows_.draw(view, {.width = 6.0f, .hidden_opacity = 0.5f});
}

}  // namespace elastolab
