#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/files/autosave.hpp"
#include "app/files/scene_io.hpp"
#include "app/files/unsaved_changes.hpp"
#include "app/messages.hpp"
#include "base/control.hpp"
#include "scene/live/background_job.hpp"
#include "scene/live/live_scene.hpp"

namespace elastolab {

/// The scene that is edited, as SceneFiles needs it.
struct EditedScene {
    std::function<LiveScene&()> scene;
    std::function<Document()> document;        ///< to be kept or saved: a movable_document()
    std::function<void()> finish_gesture;      ///< so that no edit is half done
    std::function<void(LoadedScene)> replace;  ///< edits this scene from now on
};

/// Opens and saves the scene that is edited, asks before changes are lost, and keeps a copy of them for the case that
/// the viewer is killed. Failures become messages; what was there stays. Owned by one thread.
class SceneFiles {
public:
    /// `wake` is called by workers when poll() or keep_copy() will find something.
    SceneFiles(EditedScene edited, Messages& messages, const std::function<void()>& wake);

    // Opening. Where changes would be lost, it waits until the person has answered.
    /// Opens a scene file (.json) or a mesh, on a worker.
    void open(const std::filesystem::path& file);
    /// The same, here and now, without a question. Throws SceneError, MeshError, Cancelled.
    void open_now(const std::filesystem::path& file, Control& control);
    void open_now(const std::filesystem::path& file) {
        Control never_cancelled;
        open_now(file, never_cancelled);
    }
    /// A document that was read from no file, without a question; ends what is being opened. base: the file that the
    /// name of its mesh is relative to.
    void open_document(Document document, const std::filesystem::path& base);
    /// The scene that is being opened begins with this; nothing where none is.
    void begin_with(const AskedFor& asked);
    /// Takes over what was opened. Once a frame.
    void poll();
    bool loading() const { return load_job_.running(); }
    /// The file that is being opened, or was last.
    const std::filesystem::path& loading_file() const { return pending_file_; }
    /// Stops opening at the next checkpoint; working(): it has not stopped yet.
    void cancel() { load_job_.cancel(); }
    bool working() const { return load_job_.working(); }

    // Saving.
    /// False when it could not be written, or is of no use: the file of its mesh is gone, or another one.
    bool save(const std::filesystem::path& file);
    /// The file that the scene came from or was last saved to; empty when there is none.
    const std::filesystem::path& file() const { return file_; }
    /// Whether that file was written here already, so that it may be written again without a question.
    bool owns_file() const { return owns_file_; }
    /// What the scene is called: its file's name, or that of its body; " (not saved)" follows where it was changed.
    std::string title() const;
    /// Files that were opened or saved, the latest first.
    const std::vector<std::filesystem::path>& recent() const { return recent_; }

    // Unsaved changes.
    UnsavedChanges unsaved;
    /// Ends the gesture; what would lose changes then waits for the person's answer.
    void guard(UnsavedChanges::Action action);
    void answer(UnsavedAnswer answer);
    /// The person wants to save a scene that has no file, or one that was only read: a name is to be asked for, then
    /// comes save().
    bool wants_name = false;

    // Copies of what is not saved.
    /// Scenes left by viewers that were killed; recover() opens the first, unsaved as it was.
    std::vector<AutosavedScene> recoverable;
    void recover();
    void discard_recoverable();
    /// Writes a copy where one is due, at this time of the window's clock [s]; true where copy_failure() is another
    /// one. Once a frame.
    bool keep_copy(double now);
    /// Seconds until keep_copy() has something to do; negative when it has not.
    double copy_due_in(double now) const { return autosave_.due_in(now); }
    /// Why the latest changes would be lost if this viewer were killed; empty while they would not.
    const std::string& copy_failure() const { return autosave_.failure(); }
    /// The session has ended as it should: no copy is left behind.
    void remove_copy() { autosave_.clear(); }

private:
    void begin_loading(const std::filesystem::path& file);
    void load(std::filesystem::path file, std::function<LoadedScene(Control&)> work);
    void take_loaded(LoadedScene loaded, const std::filesystem::path& file);
    void replace(LoadedScene loaded);
    void add_recent(const std::filesystem::path& file);
    /// What became of the file of the mesh since it was read, as the end of a sentence; empty where nothing did.
    std::string mesh_file_problem(const Document& document) const;
    /// Of the scene; another one has other revisions.
    std::uint64_t revision() const;

    EditedScene edited_;
    Messages& messages_;
    std::filesystem::path file_;
    bool owns_file_ = false;
    /// When the file of the mesh was last written before the scene was opened; none where it has no such file.
    std::optional<std::filesystem::file_time_type> mesh_written_;
    std::vector<std::filesystem::path> recent_;
    std::filesystem::path pending_file_;  ///< being loaded since the scene had this revision:
    std::uint64_t revision_at_open_ = 0;
    AskedFor asked_;                                        ///< of the one being loaded
    std::optional<AutosavedScene> recovering_, recovered_;  ///< being opened; open, but not adopted by autosave_ yet
    std::uint64_t n_replaced_ = 0;
    BackgroundJob<std::shared_ptr<LoadedScene>> load_job_;
    Autosave autosave_;
};

}  // namespace elastolab
