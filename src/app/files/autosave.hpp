#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/file_descriptor.hpp"
#include "scene/document.hpp"
#include "scene/live/background_job.hpp"

namespace elastolab {

/// A scene that a viewer was editing, kept while its lock is held. The lock is a file beside it, locked (flock) by the
/// viewer that edits it: the system lets go of it however that viewer ends.
struct AutosavedScene {
    std::filesystem::path file;    ///< the scene, complete, with the absolute name of its mesh
    std::filesystem::path lock;    ///< names the scene file that it belongs to
    std::filesystem::path origin;  ///< that file; empty when it was never saved
    std::string body;              ///< its mesh file or primitive, by name; empty where the copy cannot be read
    std::filesystem::file_time_type time;
    FileDescriptor locked;

    /// Deletes it: it is not wanted any more.
    void remove();
};

/// Scenes left by viewers that were killed, the newest first. Each is locked, so that no other viewer finds it; those
/// of running viewers are not among them. Never throws: at worst, nothing can be recovered.
std::vector<AutosavedScene> find_autosaved();

/// Writes the scene that is edited, on a worker, whenever it has changed and is not saved: at most every two seconds.
/// What failed is tried again after as long. All members are for one thread.
class Autosave {
public:
    /// `wake` is called by the worker when it has ended.
    explicit Autosave(std::function<void()> wake) : job_(std::move(wake)) {}

    /// What there is to keep.
    struct Scene {
        std::uint64_t revision = 0;  ///< another one for every other state
        bool modified = false;
        std::filesystem::path origin;        ///< its file; may be empty
        std::function<Document()> document;  ///< with absolute names; called when it is written
    };
    /// Once a frame. A scene that is not modified needs no copy: what was written is removed.
    void update(const Scene& scene, double now);
    /// Seconds until update() has something to do; negative when it has not.
    double due_in(double now) const;
    /// The next scene was recovered from this one, whose file is overwritten when the scene changes.
    void adopt(AutosavedScene scene);
    /// The session has ended as it should: nothing is left behind.
    void clear();
    /// Why the latest changes are not kept, for the user; empty once they are.
    const std::string& failure() const { return failure_; }

private:
    void poll();
    void make_place();
    void name_origin(const std::filesystem::path& origin);
    void fail(std::string why);

    std::optional<AutosavedScene> place_;
    std::optional<std::uint64_t> written_;  ///< revision
    bool wanted_ = false, origin_is_named_ = false;
    std::string failure_;
    double last_ = -1e9;
    BackgroundJob<bool> job_;
};

}  // namespace elastolab
