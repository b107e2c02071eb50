#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/files/autosave.hpp"
#include "app/files/exports.hpp"
#include "app/files/scene_io.hpp"
#include "app/files/unsaved_changes.hpp"
#include "app/input/gestures.hpp"
#include "app/measurements.hpp"
#include "app/messages.hpp"
#include "app/picture/shown_scene.hpp"
#include "app/probes.hpp"
#include "app/settings.hpp"
#include "app/viewer_requests.hpp"
#include "methods/registry.hpp"
#include "render/camera.hpp"
#include "scene/live/background_job.hpp"
#include "scene/live/live_scene.hpp"
#include "scene/live/simulation.hpp"
#include "scene/user_text.hpp"

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

    // Scenes. Failures become messages; what was there stays. What would lose unsaved changes waits until the person
    // has answered: open, open_primitive and quit then only ask.
    /// Opens a scene file (.json) or a mesh, on a worker.
    void open(const std::filesystem::path& file);
    /// The same, here and now, without a question. Throws SceneError, MeshError, Cancelled.
    void open_now(const std::filesystem::path& file, Control& control);
    void open_now(const std::filesystem::path& file) {
        Control never_cancelled;
        open_now(file, never_cancelled);
    }
    void open_document(Document document, const std::filesystem::path& scene_file);
    /// A new body of the present material, held where its kind usually is.
    void open_primitive(const Primitive& primitive);
    void quit();
    UnsavedChanges unsaved;
    void answer_unsaved(UnsavedAnswer answer);
    /// The file that the scene came from or was last saved to; empty when there is none.
    const std::filesystem::path& scene_file() const { return scene_file_; }
    /// What the scene is called: its file's name, or that of its body; " (not saved)" follows where it was changed.
    std::string scene_title() const;
    /// Whether that file was written here already, so that it may be written again without a question.
    bool owns_scene_file() const { return owns_scene_file_; }
    /// False when it could not be written.
    bool save_scene(const std::filesystem::path& file);
    void save_probes(const std::filesystem::path& file);
    /// Writes a mesh, or fields, on a worker (write_export).
    void export_mesh(const std::filesystem::path& file);
    const std::vector<std::filesystem::path>& recent_files() const { return recent_; }
    /// Scenes left by viewers that were killed; recover() opens the first, unsaved as it was.
    std::vector<AutosavedScene> recoverable;
    void recover();
    void discard_recoverable();
    /// What was recovered, once it is open: whoever takes it keeps the scene there from then on (Autosave::adopt).
    std::optional<AutosavedScene> take_recovered() { return std::exchange(recovered_, std::nullopt); }
    /// Why the latest changes would be lost if this viewer were killed; empty while they would not.
    std::string keeping_failure;
    /// The method to begin with, for the scene that is there and the one that is being opened.
    void start_with(MethodKind kind);

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

    // Frames.
    /// Takes over what workers finished and brings displacements, and then what is shown of them, up to date.
    /// Each returns whether something changed.
    bool update_displacements();
    bool update_picture();
    bool loading() const { return load_job_.running(); }
    /// The file that is being opened, or was last.
    const std::filesystem::path& loading_file() const { return pending_file_; }
    /// The file that a worker writes; empty when none does.
    std::filesystem::path exported_file() const { return exports_.file(); }
    /// The first file is being opened: until it is there, nothing is shown that could be pulled.
    bool blank() const { return loading() && !simulated_; }
    /// A worker will bring something for the picture.
    bool waiting() const {
        return loading() || exports_.running() || shown.cutting() || shown.solving() || simulation.waiting();
    }
    /// What is shown is not yet the converged answer to the scene as it is.
    bool answering() const;
    /// Stops all workers at their next checkpoints; stopping(): some have not stopped yet.
    void cancel_workers();
    bool stopping() const {
        return load_job_.working() || exports_.working() || shown.working() || simulation.stopping();
    }

private:
    void take_scene(LoadedScene loaded);
    void begin_loading(const std::filesystem::path& file);
    void take_loaded(LoadedScene loaded, const std::filesystem::path& file);
    void make_primitive_scene(const Primitive& primitive);
    void poll_loading();
    void keep_method();
    void take_method();
    std::string selected_fixed_name() const;
    std::string selected_handle_name() const;
    void take_step(const std::function<void()>& step);
    void add_recent(const std::filesystem::path& file);
    /// False when it failed, which becomes a message.
    template <class Action>
    bool attempt(const Action& action);

    std::unique_ptr<LiveScene> scene_;
    std::unique_ptr<VertexGraph> graph_;
    std::uint64_t scene_number_ = 0;
    std::filesystem::path scene_file_;
    bool owns_scene_file_ = false;
    bool has_saved_view_ = false;  ///< the scene was saved with its camera
    bool simulated_ = false;       ///< something was computed already
    std::vector<std::filesystem::path> recent_;
    std::vector<int> prefetched_;
    std::filesystem::path pending_file_;  ///< being loaded since the scene had this revision:
    std::uint64_t revision_at_open_ = 0;
    std::optional<MethodKind> first_method_;
    std::optional<AutosavedScene> recovering_, recovered_;
    BackgroundJob<std::shared_ptr<LoadedScene>> load_job_;
    Exports exports_;
};

template <class Action>
bool ViewerState::attempt(const Action& action) {
    try {
        action();
        return true;
    } catch (const std::exception& error) {
        messages.error(user_text(error));
        return false;
    }
}

}  // namespace elastolab
