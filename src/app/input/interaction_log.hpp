#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "app/window/input_event.hpp"
#include "base/atomic_file.hpp"

namespace elastolab {

/// The events that one frame dealt with.
struct LoggedFrame {
    double seconds = 0.0;  ///< since the recording began
    std::vector<InputEvent> events;
    std::optional<Eigen::Vector2i> window_size = {};  ///< where it is another one from here on
};

/// A recorded interaction: every frame that had events, in a window that has this size at first.
struct InteractionLog {
    Eigen::Vector2i window_size = {1280, 800};  ///< logical pixels
    std::vector<LoggedFrame> frames;
};

/// Writes an interaction log (docs/reference.md, "Files of the viewer"): JSON lines, a header and one line for each
/// frame. The file appears under its name when it is complete, that is with finish() or at the end.
class InteractionRecorder {
public:
    /// Throws Error when the file cannot be written.
    InteractionRecorder(const std::filesystem::path& file, const Eigen::Vector2i& window_size);
    ~InteractionRecorder();
    /// Its window size is kept where it differs from the last.
    void add(const LoggedFrame& frame);
    /// Throws Error when the disk is full or the like.
    void finish();
    const std::filesystem::path& file() const { return path_; }

private:
    std::filesystem::path path_;
    std::unique_ptr<AtomicFile> file_;
    Eigen::Vector2i window_size_;
};

/// Throws SceneError naming file, line, finding and a way forward.
InteractionLog load_interaction(const std::filesystem::path& file);

}  // namespace elastolab
