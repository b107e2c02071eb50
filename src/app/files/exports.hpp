#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "app/files/export_source.hpp"
#include "app/messages.hpp"
#include "scene/live/background_job.hpp"

namespace elastolab {

/// Meshes, fields and figures written for other programs, one at a time; what becomes of each is a message.
class Exports {
public:
    /// `wake` is called by the worker when poll() will find something.
    explicit Exports(const std::function<void()>& wake) : job_(wake) {}

    /// Writes what `make_source` returns (write_export): here and now where that is the work of a frame, else on a
    /// worker. Refused while another one is being written. remark: what the note that tells of it ends with.
    void start(const std::filesystem::path& file, const std::function<ExportSource()>& make_source,
               const std::string& remark, Messages& messages);
    /// Whether one has ended since the last call.
    bool poll(Messages& messages);

    /// The file that is being written; empty when none is.
    std::filesystem::path file() const { return running() ? file_ : std::filesystem::path(); }
    bool running() const { return job_.running(); }
    /// Stops it at its next checkpoint; working(): it has not stopped yet.
    void cancel() { job_.cancel(); }
    bool working() const { return job_.working(); }

private:
    std::filesystem::path file_;
    BackgroundJob<std::string> job_;  ///< with its note
};

}  // namespace elastolab
