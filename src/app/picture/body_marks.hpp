#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "app/picture/palette.hpp"
#include "app/picture/patch_areas.hpp"
#include "app/viewer_state.hpp"
#include "render/drawing/arrows_drawing.hpp"
#include "render/drawing/points_drawing.hpp"

namespace elastolab {

/// What stands at one method's body to be seen and taken hold of: fixed sets, handles and loads as areas or dots,
/// arrows of reactions and loads, and what the mouse points at. Needs a current OpenGL context.
class BodyMarks {
public:
    /// Puts together anew what scene, body, choices or the mouse have changed.
    void update(const ViewerState& state, const ShownBody& body, const Palette& palette, const SceneFrame& frame);
    /// How often areas, dots and arrows were put together.
    int n_updates() const { return n_updates_; }

    /// Over the body, which is drawn already.
    void draw_areas(const SceneView& view) {
        areas_.draw(view);
        hover_area_.draw(view);
    }
    /// Dots and arrows, on a body of so many vertices.
    void draw(const SceneView& view, int n_vertices, const Palette& palette);

private:
    /// What all of it depends on but for the mouse: the same key, the same marks.
    struct Key {
        std::uint64_t scene_revision = 0, body_revision = 0;
        const Palette* palette = nullptr;
        bool constraints = false, arrows = false, has_field = false;
        int selected_fixed = -1, selected_handle = -1;
        std::optional<int> selected_load = {};
        std::optional<DraggedLoad> dragged = {};
        float size = 1.0f;  ///< of the dots
        bool operator==(const Key&) const = default;
    };
    static Key key_of(const ViewerState& state, const ShownBody& body, const Palette& palette);
    void update_areas(const ViewerState& state, const ShownBody& body, const Key& key, const SceneFrame& frame);
    void update_arrows(const ViewerState& state, const ShownBody& body, const Key& key, const SceneFrame& frame);
    void update_hover(const ViewerState& state, const ShownBody& body, const Key& key, const SceneFrame& frame);

    std::optional<Key> key_;
    Hover hover_;
    bool dragging_ = false;
    int n_updates_ = 0;
    std::vector<char> seen_;         ///< whether each vertex is: where the body is cut open, those of what is left
    std::vector<PointSprite> dots_;  ///< of the patches that are no areas
    PatchAreas areas_, hover_area_;
    PointsDrawing points_;
    ArrowsDrawing arrows_;
};

}  // namespace elastolab
