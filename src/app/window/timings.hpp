#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/atomic_file.hpp"

namespace elastolab {

/// What one frame took, in milliseconds, as measured: the displacements of all shown methods; making vertex data of
/// them and handing it to OpenGL; drawing the scene; the panels; everything from the first event to the swap of
/// buffers.
struct FrameTimes {
    double update_ms = 0.0, upload_ms = 0.0, draw_ms = 0.0, gui_ms = 0.0, frame_ms = 0.0;
};

/// One row of the timings file.
struct FrameRecord {
    int frame = 0;
    double time_s = 0.0;  ///< Window::seconds()
    std::string method;
    int vertices = 0, constrained_vertices = 0, handle_vertices = 0;
    std::string state;  ///< "idle", "precomputing" or "ready"
    FrameTimes times;
};

/// The last frames, for the panel.
class FrameHistory {
public:
    static constexpr std::size_t kLength = 240;

    void add(const FrameTimes& times);
    std::size_t size() const { return size_; }
    /// One of the times, for the kept frames, oldest first.
    std::vector<float> series(double FrameTimes::*which) const;
    /// Fraction q in [0, 1] of the frames took no longer; 0 when there is none.
    double percentile(double FrameTimes::*which, double q) const;

private:
    std::array<FrameTimes, kLength> ring_{};
    std::size_t size_ = 0, next_ = 0;
};

/// Writes the timings CSV (docs/reference.md, "Files of the viewer"): a row for every frame that was drawn. The file
/// appears under its name when it is complete, that is with finish() or at the end.
class TimingsRecorder {
public:
    /// Throws Error when the file cannot be written.
    explicit TimingsRecorder(const std::filesystem::path& file);
    ~TimingsRecorder();

    void add(const FrameRecord& record);
    /// Throws Error when the disk is full or the like.
    void finish();
    int n_rows() const { return n_rows_; }
    const std::filesystem::path& file() const { return path_; }

private:
    std::filesystem::path path_;
    std::unique_ptr<AtomicFile> file_;
    int n_rows_ = 0;
};

}  // namespace elastolab
