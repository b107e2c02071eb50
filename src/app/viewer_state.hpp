#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/input/gestures.hpp"
#include "app/input/interaction_log.hpp"
#include "app/panels/messages.hpp"
#include "app/picture/section_volume.hpp"
#include "app/picture/shown_body.hpp"
#include "app/settings.hpp"
#include "app/window/timings.hpp"
#include "methods/registry.hpp"
#include "render/camera.hpp"
#include "scene/live/background_job.hpp"
#include "scene/live/live_scene.hpp"
#include "scene/live/simulation.hpp"

namespace elastolab {

/// A view of one or more methods' answers, somewhere in the window.
struct SceneViewport {
    Viewport place;
    std::vector<MethodKind> kinds;  ///< the first is the solid one, the others are its ghosts
};

/// A scene as it comes from a file, and which axis it has upward.
struct LoadedScene {
    std::unique_ptr<LiveScene> scene;
    Eigen::Vector3d up_axis = Eigen::Vector3d::UnitZ();
};

/// Everything that the viewer shows and edits, without any window: panels and gestures work on it. Owned by one thread.
class ViewerState {
public:
    /// `wake` is called by workers when update() will find something.
    explicit ViewerState(const std::function<void()>& wake);

    // What is edited.
    LiveScene& scene() { return *scene_; }
    const LiveScene& scene() const { return *scene_; }
    const VertexGraph& graph() const { return *graph_; }
    Simulation simulation;
    MethodChoices choices;
    MethodKind method = default_method();
    ToolSettings tools;
    CompareSettings compare;
    DisplaySettings display;
    Gestures gestures;
    Camera camera;
    Messages messages;

    // What is shown.
    std::vector<SceneViewport> viewports;  ///< where the scene is in this frame
    std::vector<ShownBody> bodies;         ///< of every method on the screen
    const ShownBody* body(MethodKind kind) const;
    bool comparing() const { return compare.mode != CompareMode::off; }
    /// Methods on the screen, the active one first; and those that must be computed for them.
    std::vector<MethodKind> shown_kinds() const;
    std::vector<MethodKind> needed_kinds() const;
    /// The reference of differences: only when something is shown that needs one.
    const MethodRunner* reference() const;
    /// The range of the colours.
    std::pair<double, double> field_range() const;

    // Measurements.
    FrameHistory history;
    FrameTimes last_frame;
    int frame = 0;
    FrameRecord frame_record(const FrameTimes& times, double now) const;
    std::unique_ptr<TimingsRecorder> timings;
    std::unique_ptr<InteractionRecorder> recorder;

    // Commands. Failures become messages; what was there stays.
    /// Opens a scene file (.json) or a mesh, on a worker.
    void open(const std::filesystem::path& file);
    /// The same, here and now. Throws.
    void open_now(const std::filesystem::path& file);
    /// The method to begin with, for the scene that is there and the one that is being opened.
    void start_with(MethodKind kind);
    void open_document(Document document, const std::filesystem::path& scene_file);
    /// A new body of the present material, held where its kind usually is.
    void open_primitive(const Primitive& primitive);
    void save_scene(const std::filesystem::path& file);
    void export_mesh(const std::filesystem::path& file);
    /// The same without words. Throw.
    void write_scene(const std::filesystem::path& file) const;
    void write_mesh(const std::filesystem::path& file) const;
    void record_timings(const std::filesystem::path& file);
    void stop_timings();
    void undo();
    void redo();
    void remove_handle(int handle);
    void clear_handles();
    void set_young_modulus(double value);
    void select_method(MethodKind kind);
    void frame_body();
    /// Ends a gesture, so that an edit from elsewhere finds no half-done one.
    void finish_gesture();
    GestureContext gesture_context();

    // Requests to the window.
    std::optional<std::filesystem::path> screenshot_request;
    bool quit_requested = false;
    bool show_help = false;

    bool loading() const { return load_job_.running(); }
    bool cutting() const { return volume_.running(); }  ///< the inside of the body is being made
    /// Stops all workers at their next checkpoints; stopping(): some have not stopped yet.
    void cancel_workers();
    bool stopping() const { return load_job_.working() || volume_.working() || simulation.stopping(); }
    std::uint64_t scene_number() const { return scene_number_; }  ///< grows when the scene is replaced
    const std::vector<std::filesystem::path>& recent_files() const { return recent_; }

    /// Takes over what workers finished and brings displacements and what is shown of them up to date.
    /// Each returns whether something changed.
    bool update_displacements();
    bool update_bodies();

private:
    void take_scene(LoadedScene loaded);
    void poll_loading();
    const Volume* volume(MethodKind kind);
    void add_recent(const std::filesystem::path& file);
    template <class Action>
    void attempt(const Action& action);

    std::unique_ptr<LiveScene> scene_;
    std::unique_ptr<VertexGraph> graph_;
    std::uint64_t scene_number_ = 0;
    bool simulated_ = false;  ///< something was computed already
    std::vector<std::filesystem::path> recent_;
    std::vector<int> prefetched_;
    std::filesystem::path pending_file_;
    std::optional<MethodKind> first_method_;
    SectionVolume volume_;
    BackgroundJob<std::shared_ptr<LoadedScene>> load_job_;
};

/// The scene that the viewer begins with: the paper's cube of about 1000 vertices, its left face fixed.
Document default_document();
/// A bare mesh as a scene in which nothing is held.
Document document_for_mesh(const std::filesystem::path& mesh);

}  // namespace elastolab
