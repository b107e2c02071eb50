#pragma once

#include <filesystem>
#include <fstream>
#include <optional>

#include "base/temporary_file.hpp"

namespace elastolab {

/// A file that is written beside its destination and takes its place once it is complete and on the disk (fsync), so
/// that no reader ever sees half a file and a failure leaves what was there before. It keeps the permissions of the
/// file that it replaces and, where this user may set them, its owner and group. A destination that is no regular file
/// (a pipe, a terminal) or an open stream of this process (/dev/stdout) is written directly; any other symbolic link is
/// followed, and the file that it leads to is replaced or created. Temporaries that killed programs left beside the
/// destination are removed.
class AtomicFile {
public:
    /// Opens the temporary. Throws Error, naming `destination`, when it is empty or a directory, when its folder is
    /// missing or not writable, or when it is a link that must not be followed (see followed_links).
    explicit AtomicFile(const std::filesystem::path& destination);
    /// Removes the temporary unless commit() was called.
    ~AtomicFile();
    AtomicFile(AtomicFile&& other) noexcept;
    AtomicFile& operator=(AtomicFile&&) = delete;

    std::ostream& stream() { return stream_; }

    /// Brings everything to the disk, beside the destination. Throws Error when that fails, say on a full disk.
    void close();
    /// close(), then the temporary becomes the destination.
    void commit();

    /// Throws what the constructor would, without leaving anything behind.
    static void require_writable(const std::filesystem::path& destination) { AtomicFile{destination}; }

private:
    void open_beside(const std::filesystem::path& destination);
    void discard();

    std::filesystem::path shown_;             ///< the destination as the user wrote it, for messages
    std::filesystem::path destination_;       ///< the file to replace
    std::optional<TemporaryFile> temporary_;  ///< none once there is nothing to remove, or when written directly
    std::ofstream stream_;
};

}  // namespace elastolab
