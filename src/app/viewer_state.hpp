#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/files/exports.hpp"
#include "app/files/scene_files.hpp"
#include "app/input/gestures.hpp"
#include "app/measurements.hpp"
#include "app/messages.hpp"
#include "app/picture/shown_scene.hpp"
#include "app/probes.hpp"
#include "app/settings.hpp"
#include "app/viewer_requests.hpp"
#include "methods/registry.hpp"
#include "render/camera.hpp"
#include "scene/live/live_scene.hpp"
#include "scene/live/simulation.hpp"

namespace elastolab {

/// Everything that the viewer shows and edits, without any window: panels and gestures work on it. Owned by one thread.
class ViewerState {
public:
    /// `wake` is called by workers when update_displacements() or update_picture() will find something.
    explicit ViewerState(const std::function<void()>& wake);

    // What is edited.
    LiveScene& scene() { return *scene_; }
    const LiveScene& scene() const { return *scene_; }
    std::uint64_t scene_number() const { return scene_number_; }  ///< grows when the scene is replaced
    const VertexGraph& graph() const { return *graph_; }
    Simulation simulation;
    MethodChoices choices;
    MethodKind method = default_method();
    ToolSettings tools;
    CompareSettings compare;
    DisplaySettings display;
    Gestures gestures;
    Camera camera;

    // What is seen.
    ShownScene shown;
    Messages messages;
    Probes probes;
    bool show_help = false;
    bool comparing() const { return compare.mode != CompareMode::off; }
    /// Compares in this way, or no more. Which methods: those chosen, else all that are ready or will be soon.
    void toggle_comparison(CompareMode mode);
    /// Methods on the screen, the active one first; and those that must be computed for them.
    std::vector<MethodKind> shown_kinds() const;
    std::vector<MethodKind> needed_kinds() const;
    /// The reference of differences: only when something is shown that needs one.
    const EmbeddedRunner* reference() const;

    /// The arrows of gravity and loads at one of the shown bodies, as they are drawn and dragged.
    const std::vector<LoadArrow>& load_arrows_at(const ShownBody& body) const {
        return shown.load_arrows_at(body, *scene_, camera.scene().radius, gestures.dragged_load());
    }

    // What is measured.
    Measurements measurements;
    FrameRecord frame_record(const FrameTimes& times, double now) const;
    void record_timings(const std::filesystem::path& file);
    void stop_timings();

    // Files. Failures become messages; what was there stays.
    SceneFiles files;
    /// A new body of the present material, held where its kind usually is. Like quit(), it only asks where unsaved
    /// changes would be lost.
    void open_primitive(const Primitive& primitive);
    void quit();
    /// The scene as it is saved: with the method, the field and the cut, and as the camera sees it.
    Document document_to_save() const;
    /// What to begin with, for the scene that is there and the one that is being opened.
    void start_with(const AskedFor& asked);
    void save_probes(const std::filesystem::path& file);
    /// Adds what the present method shows of this scene, when it is new.
    void record_probes(double now);
    /// A handle is to be moved by the force that moves it now, as soon as that is known.
    void move_by_force(int handle);
    /// What the present method shows, to be written.
    ExportSource export_source_now() const;
    /// Writes a mesh, or fields, on a worker (write_export).
    void export_mesh(const std::filesystem::path& file);
    /// The file that a worker writes; empty when none does.
    std::filesystem::path exported_file() const { return exports_.file(); }

    // Edits.
    void undo();
    void redo();
    void remove_handle(int handle);
    void clear_handles();
    void remove_load(int load);
    void clear_loads();  ///< and gravity
    void remove_fixed_set(int set);
    void set_young_modulus(double value);
    void select_method(MethodKind kind);
    /// Finds the equilibrium of a method that is not linear anew, from rest, and tells whether it is another.
    void begin_from_rest();
    void frame_body();

    /// The number of viewports has changed: frames the body, except the first time that a scene saved with its
    /// camera is seen.
    void frame_in_viewports(bool first_time);
    /// Ends a gesture, so that an edit from elsewhere finds no half-done one.
    void finish_gesture();
    GestureContext gesture_context();
    /// What can be taken hold of in the scene.
    std::vector<Gizmo> gizmos() const;

    ViewerRequests requests;
    std::optional<PictureProgress> pictures_under_way;
    bool posed_for_film = false;  ///< handles are part of their way, for a frame of a film

    // Frames.
    /// Takes over what workers finished and brings displacements, and then what is shown of them, up to date.
    /// Each returns whether something changed.
    bool update_displacements();
    bool update_picture();
    /// The first file is being opened: until it is there, nothing is shown that could be pulled.
    bool blank() const { return files.loading() && !simulated_; }
    /// A worker will bring something for the picture.
    bool waiting() const {
        return files.loading() || exports_.running() || shown.cutting() || shown.solving() || simulation.waiting();
    }
    /// What is shown is not yet the converged answer to the scene as it is.
    bool answering() const;
    /// Stops all workers at their next checkpoints; stopping(): some have not stopped yet.
    void cancel_workers();
    bool stopping() const { return files.working() || exports_.working() || shown.working() || simulation.stopping(); }

private:
    void take_scene(LoadedScene loaded);
    void make_primitive_scene(const Primitive& primitive);
    void keep_method();
    void place_grips();
    void take_method();
    std::string selected_fixed_name() const;
    std::string selected_handle_name() const;
    void take_step(const std::function<void()>& step);
    std::optional<GripForce> present_force(int handle) const;
    void take_wanted_force();
    void tell_from_rest();

    std::unique_ptr<LiveScene> scene_;
    std::unique_ptr<VertexGraph> graph_;
    std::uint64_t scene_number_ = 0;
    /// An equilibrium that is found anew, from rest.
    struct FromRest {
        MethodKind method;
        std::uint64_t revision;  ///< of the scene
        Eigen::VectorXd before;  ///< displacements
    };
    std::optional<FromRest> from_rest_;
    std::string moved_by_force_;   ///< a handle whose force is waited for
    bool has_saved_view_ = false;  ///< the scene was saved with its camera
    bool simulated_ = false;       ///< something was computed already
    std::vector<int> prefetched_;
    Exports exports_;
};

}  // namespace elastolab
