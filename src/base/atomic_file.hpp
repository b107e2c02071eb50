#pragma once

#include <filesystem>
#include <fstream>

namespace elastolab {

/// A file that is written beside its destination and takes its place once it is complete, so that no reader ever sees
/// half a file and a failure leaves what was there before. A destination that is no regular file (a pipe, a terminal)
/// or an open stream of this process (/dev/stdout) is written directly; through any other symbolic link the file that
/// it leads to is replaced.
class AtomicFile {
public:
    /// Opens the temporary. Throws Error, naming `destination`, when it is empty or a directory, or when its folder is
    /// missing or not writable.
    explicit AtomicFile(const std::filesystem::path& destination);
    /// Removes the temporary unless commit() was called.
    ~AtomicFile();
    AtomicFile(AtomicFile&& other) noexcept;
    AtomicFile& operator=(AtomicFile&&) = delete;

    std::ostream& stream() { return stream_; }
    /// The file that is being written; it has the extension of the destination, for writers that go by it. Such a
    /// writer may replace it altogether instead of using stream().
    const std::filesystem::path& temporary() const { return temporary_; }

    /// Flushes everything to the temporary. Throws Error when that fails, say on a full disk.
    void close();
    /// close(), then the temporary becomes the destination.
    void commit();

    /// Throws what the constructor would, without leaving anything behind.
    static void require_writable(const std::filesystem::path& destination) { AtomicFile{destination}; }

private:
    std::filesystem::path shown_;  ///< the destination as the user wrote it, for messages
    std::filesystem::path destination_;
    std::filesystem::path temporary_;  ///< empty once there is nothing to remove
    std::ofstream stream_;
};

}  // namespace elastolab
