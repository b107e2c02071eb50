#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/input/gizmo.hpp"
#include "app/input/patch.hpp"
#include "app/picture/load_arrows.hpp"
#include "app/settings.hpp"
#include "app/window/input_event.hpp"
#include "render/camera.hpp"
#include "render/geometry/picking.hpp"
#include "scene/live/live_scene.hpp"

namespace elastolab {

/// A view of the body that can be pointed at.
struct PointingTarget {
    Viewport viewport;
    /// As shown. The vertices of the surface come first; where the body is cut open, those inside follow.
    const Positions* positions = nullptr;
    const Triangles* triangles = nullptr;
};

/// What gestures work on. All views share one camera.
struct GestureContext {
    LiveScene& scene;
    Camera& camera;
    const VertexGraph& graph;
    const ToolSettings& tools;
    DisplaySettings& display;  ///< the plane of the cut is moved
    std::vector<PointingTarget> targets;
    std::vector<Gizmo> gizmos = {};  ///< that can be taken hold of
    std::vector<LoadArrow> load_arrows = {};

    /// False for vertices inside the body: they show where it is cut open, and cannot be grabbed.
    bool is_on_surface(int vertex) const { return vertex < scene.mesh().n_vertices(); }
};

/// What the cursor points at when no button is down.
struct Hover {
    int vertex = -1;
    std::vector<int> patch = {};  ///< that a press would grab: of the handle it belongs to, or a new one
    std::optional<std::pair<int, GizmoPart>> part = {};  ///< of a gizmo, by the gizmo's handle
    std::optional<int> load = {};                        ///< whose arrow has its end there

    bool operator==(const Hover&) const = default;
};

/// What brush and box do to vertices.
enum class Hold { fix, free };

/// Turns mouse events into camera moves and edits of the scene. Owned by one thread; knows no window.
///   body     left: grab a handle or make one, and pull it. While pulling: Shift along the normal, X/Y/Z along an axis,
///            Ctrl (or R) turns the patch, Alt (or S) scales it, Delete removes it. A fixed vertex cannot be pulled
///   empty    left: orbit; Shift + left: pan; double click: frame the body
///   anywhere middle: orbit; right, Shift + middle or Ctrl + middle: pan. These three by the choice of Navigation
///   axes     a click on a letter: look along that axis, at the second click from the other side
///   gizmo    left: an arrow moves the handle (or the plane of the cut), a ring turns it, by any angle; Ctrl snaps
///   wheel    zoom to the cursor
///   brush    left adds vertices under the brush to the selected fixed set, with Shift frees them; a click does so
///            with one vertex
///   box      left draws a box, likewise
///   probe    a click chooses a vertex, a drag turns the view
///   arrow    left: the end of a load's arrow is dragged, and the load changes; with the same keys as a pull
///   force    left on the body: takes the force there or makes one, whose arrow grows with the mouse
///   pressure left adds the triangles under the brush to the selected pressure or a new one, with Shift takes them out
class Gestures {
public:
    /// blocked: the button is down where it can do nothing, which hint() explains.
    enum class Action { none, orbit, pan, zoom, pull, plane, paint, box, load, blocked };

    void handle(const InputEvent& event, GestureContext& context);
    /// Moves what springs back; true while something does.
    bool animate(double now, GestureContext& context);
    /// Ends at once what is going on (before an edit from elsewhere).
    void finish(GestureContext& context);
    /// Forgets everything: the scene was replaced.
    void reset();

    Action action() const { return action_; }
    bool pulling() const { return action_ == Action::pull; }
    /// A handle or a load follows the mouse.
    bool dragging() const { return pulling() || action_ == Action::load; }
    /// Whether what the button does now changes the scene, and Esc takes it back.
    bool edits() const { return dragging() || action_ == Action::paint; }
    const Hover& hover() const { return hover_; }
    void clear_hover() { hover_ = {}; }
    /// The handle that was grabbed last (or chosen), for the panel and for removal; -1: none. What is selected takes
    /// the place of what was, but for the fixed set, which brush and box go on to change.
    int selected_handle() const { return selected_; }
    /// The last one that was, whatever was selected after it.
    int last_handle() const { return last_handle_; }
    void select_handle(int handle) {
        selected_ = handle;
        if (handle < 0) return;
        last_handle_ = handle;
        fixed_is_latest_ = load_is_latest_ = false;
        selected_load_.reset();
    }
    /// The fixed set that brush and box change: -1: add to the last one, and free vertices of all; n_fixed_sets(): a
    /// new one, from the next stroke on.
    int selected_fixed() const { return selected_fixed_; }
    void select_fixed(int set) {
        keep_fixed(set);
        fixed_is_latest_ = set >= 0;
        if (set < 0) return;
        selected_ = -1;
        select_load(std::nullopt);
    }
    /// The load that was dragged last (or chosen), LiveScene::kGravity for gravity.
    const std::optional<int>& selected_load() const { return selected_load_; }
    void select_load(std::optional<int> load) {
        selected_load_ = load;
        load_is_latest_ = load.has_value();
        if (load) selected_ = -1;
    }
    /// Whether it was selected after handles and fixed sets.
    bool load_is_latest() const { return load_is_latest_; }
    /// The load whose arrow is dragged, or was last and is selected.
    std::optional<DraggedLoad> dragged_load() const;
    /// The same set under a new number: which selection is the latest stays.
    void keep_fixed(int set) { selected_fixed_ = set; }
    /// Of a handle and a fixed set that are both selected, whether the fixed set was selected last.
    bool fixed_is_latest() const { return fixed_is_latest_; }
    /// The box that is being drawn: two corners [pixels].
    std::optional<std::pair<Eigen::Vector2d, Eigen::Vector2d>> box() const;
    const Eigen::Vector2d& cursor() const { return cursor_; }
    /// What the person should know about the last press ("This vertex is fixed. ..."); empty mostly.
    const std::string& hint() const { return hint_; }
    /// The vertex that was clicked with the probe, once.
    std::optional<int> take_probed() { return std::exchange(probed_, std::nullopt); }
    /// What is pulled through a spring: the place on the patch where the spring is fastened, as shown, and the force in
    /// it; nothing where none is.
    struct SpringPull {
        int vertex = -1;
        Eigen::Vector3d force = Eigen::Vector3d::Zero();
    };
    std::optional<SpringPull> spring_pull(const LiveScene& scene) const;
    /// A part of a gizmo while it is dragged.
    struct GizmoDrag {
        Gizmo gizmo;  ///< as it was taken hold of
        GizmoPart part;
        Eigen::Vector2d cursor = Eigen::Vector2d::Zero();  ///< where it is by now
        double turned = 0.0;                               ///< by a ring, sum of all that dragged() gave [radians]
        double amount = 0.0;  ///< along an arrow or turned, in steps where they are asked for
    };
    const std::optional<GizmoDrag>& gizmo_drag() const { return gizmo_drag_; }
    /// True once after a double click.
    bool take_frame_request() { return std::exchange(frame_requested_, false); }

private:
    static constexpr double kClickPixels = 3.0;  ///< a press that moved no further is a click

    /// Whether the press made the handle, so that a mere click takes it away again.
    enum class Grabbed { present_handle, new_handle };
    struct Pull {
        int handle = -1;
        Grabbed grabbed = Grabbed::present_handle;
        bool moved = false;
        bool had_force = false;                             ///< which moved it when it was grabbed
        int vertex = -1;                                    ///< under the cursor
        Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< of the surface there when it was grabbed
        PullMode mode = PullMode::plane;
        // At the beginning, or when the mode last changed:
        Eigen::Vector2d cursor = Eigen::Vector2d::Zero();
        Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< of the vertex, as shown
        Motion motion;
        Motion before = AffineMotion{};                     ///< where it springs back to
        double spring = 0.0;                                ///< that it is pulled through; 0: none
        Eigen::Vector3d tension = Eigen::Vector3d::Zero();  ///< of the spring, were the patch at rest [force]
        Eigen::Vector3d moment = Eigen::Vector3d::Zero();   ///< that acts on the handle besides [force * L]
    };
    struct Spring {
        int handle = -1;
        Motion from, to;
        double begin = -1.0;  ///< set when it first moves
    };

    struct LoadDrag {
        LoadArrow arrow;  ///< as it was taken hold of
        bool is_new = false, moved = false;
        int handle_before = -1;  ///< that was selected
        // At the beginning, or when the mode last changed:
        PullMode mode = PullMode::plane;
        Eigen::Vector2d cursor = Eigen::Vector2d::Zero();
        Eigen::VectorXd before = {};                    ///< the load: 3, or 1 for a pressure
        Eigen::Vector3d end = Eigen::Vector3d::Zero();  ///< of the arrow
    };

    // Events: gestures.cpp
    void press(const InputEvent& event, GestureContext& context);
    void take_back(GestureContext& context);
    void keep_selection_within(const LiveScene& scene);
    void press_body(GestureContext& context, const PickHit& hit);
    int add_handle_in_place(GestureContext& context, const std::vector<int>& patch);
    void release(GestureContext& context);
    void move(GestureContext& context);
    void point(GestureContext& context);
    bool is_double_click(const InputEvent& event);
    const PointingTarget* target_at(const GestureContext& context) const;
    std::optional<PickHit> hit_in(const GestureContext& context, const PointingTarget& target) const;

    // The view: view_gesture.cpp
    void press_view(const InputEvent& event, const GestureContext& context);
    bool press_axes(GestureContext& context, const PointingTarget& target);
    void move_view(GestureContext& context, const Eigen::Vector2d& before);
    void scroll(const InputEvent& event, GestureContext& context);
    void zoom(double factor, GestureContext& context, const PointingTarget& target);
    const PointingTarget* target_of_fingers(const GestureContext& context);
    void move_by_fingers(const InputEvent& event, GestureContext& context);
    void keep_drags_in_view(GestureContext& context);

    // Brush and box: brush_gesture.cpp
    void paint(GestureContext& context);
    void end_box(GestureContext& context);
    void fix_or_free(const GestureContext& context, std::vector<int> vertices, Hold hold);
    void toggle_fixed(GestureContext& context, int vertex);

    // Pulls: pull_gesture.cpp
    void begin_pull(GestureContext& context, int handle, Grabbed grabbed, const PickHit& hit);
    void remove_pulled(GestureContext& context);
    void set_baseline(GestureContext& context);
    void pull(GestureContext& context);
    PullMode pull_mode(const ToolSettings& tools) const;
    Eigen::Vector3d pull_shift(const GestureContext& context) const;
    void pull_by_spring(GestureContext& context);
    Eigen::Vector3d pulled_center(const Positions& rest) const;
    void turn_pulled(GestureContext& context, const Eigen::Vector3d& turn);
    void end_pull(GestureContext& context);
    static Motion on_the_way_back(const Spring& spring, double part, const Positions& rest);
    void end_spring(GestureContext& context);

    // Gizmos: gizmo_gesture.cpp
    bool press_gizmo(GestureContext& context, const PointingTarget& target);
    double gizmo_amount(const GestureContext& context);
    bool snaps(const ToolSettings& tools) const;
    void pull_by_gizmo(GestureContext& context);
    void move_plane(GestureContext& context);

    // Loads: load_gesture.cpp
    std::optional<int> arrow_at(const GestureContext& context, const PointingTarget& target) const;
    bool press_arrow(GestureContext& context, const PointingTarget& target);
    void press_force(GestureContext& context, const PickHit& hit);
    void begin_load(GestureContext& context, const LoadArrow& arrow, bool is_new);
    void set_load_baseline(const GestureContext& context);
    Eigen::Vector3d load_shift(const GestureContext& context) const;
    void drag_load(GestureContext& context);
    void end_load(GestureContext& context);
    void remove_dragged_load(GestureContext& context);
    void paint_pressure(GestureContext& context, std::vector<int> vertices);

    Action action_ = Action::none;
    int button_ = -1;
    std::size_t target_ = 0;              ///< the one that the action goes on in
    std::ptrdiff_t fingers_target_ = -1;  ///< the one that fingers came down in; negative: none so far
    Eigen::Vector2d cursor_ = Eigen::Vector2d::Zero(), last_cursor_ = cursor_, press_cursor_ = cursor_;
    bool dragged_ = false;
    Hold hold_ = Hold::fix;  ///< what brush and box do
    int modifiers_ = 0;
    std::vector<int> held_keys_;
    Hover hover_;
    Pull pull_;
    std::optional<Spring> spring_;
    std::optional<GizmoDrag> gizmo_drag_;
    std::optional<DraggedLoad> last_dragged_;  ///< for the way it points
    std::optional<LoadDrag> load_drag_;
    Eigen::Vector2d painted_to_ = cursor_;  ///< where the present stroke has come to
    std::vector<int> painted_;              ///< by the present stroke of a pressure: they may have no triangle yet
    DisplaySettings plane_before_;          ///< as it was taken hold of
    int selected_ = -1, last_handle_ = -1, selected_fixed_ = -1;
    std::optional<int> selected_load_;
    bool fixed_is_latest_ = false, load_is_latest_ = false;
    double last_press_seconds_ = -1.0;
    Eigen::Vector2d last_press_ = Eigen::Vector2d::Zero();
    bool frame_requested_ = false;
    std::optional<int> probed_;
    std::string hint_;
};

}  // namespace elastolab
