#include "base/atomic_file.hpp"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <system_error>
#include <utility>

#include "base/error.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

/// Short, so that a long but legal destination does not become a name that is too long; the same extension.
fs::path temporary_beside(const fs::path& destination) {
    static std::atomic<int> count{0};
    const std::string stem = ".elastolab-" + std::to_string(getpid()) + "-" + std::to_string(count++);
    return destination.parent_path() / (stem + destination.extension().string());
}

/// Whether a path leads to a stream that this process holds open, as /dev/stdout and /dev/fd/3 do. Behind it may be a
/// regular file, which must be written on, not replaced under the hands of others who write on it.
bool is_open_stream(fs::path path) {
    constexpr int kMostLinks = 40;
    std::error_code error;
    for (int i = 0; i < kMostLinks; ++i) {
        const fs::path folder = fs::canonical(fs::absolute(path).parent_path(), error);
        if (error) return false;
        if (folder.string().rfind("/proc/", 0) == 0 && folder.filename() == "fd") return true;
        if (!fs::is_symlink(path, error)) return false;
        path = folder / fs::read_symlink(path, error);
    }
    return false;
}

/// The file that has to be replaced, which for a symbolic link is the one it leads to.
fs::path replaced_file(const fs::path& destination) {
    std::error_code error;
    const fs::path target = fs::canonical(destination, error);
    return error ? destination : target;
}

bool is_written_directly(const fs::path& destination) {
    std::error_code error;
    return is_open_stream(destination) || (fs::exists(destination, error) && !fs::is_regular_file(destination, error));
}

[[noreturn]] void fail(const fs::path& shown, const std::string& finding) {
    throw Error(shown.string() + ": " + finding);
}

void require_folder(const fs::path& shown) {
    const fs::path folder = shown.has_parent_path() ? shown.parent_path() : fs::path(".");
    std::error_code error;
    if (!fs::exists(folder, error)) fail(shown, "its folder does not exist. Create it or choose another place.");
    if (!fs::is_directory(folder, error)) fail(shown, "what should be its folder is a file. Choose another place.");
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& destination) : shown_(destination) {
    if (destination.filename().empty()) fail(shown_, "is not the name of a file. Name the file to write.");
    std::error_code error;
    if (fs::is_directory(destination, error)) fail(shown_, "is a folder. Name a file to write.");
    require_folder(shown_);
    const bool direct = is_written_directly(destination);
    destination_ = direct ? destination : replaced_file(destination);
    temporary_ = direct ? destination_ : temporary_beside(destination_);
    errno = 0;
    stream_.open(temporary_, std::ios::binary | (direct ? std::ios::app : std::ios::trunc));
    if (stream_) return;
    const std::string reason = std::generic_category().message(errno);
    temporary_.clear();
    fail(shown_, "cannot be written there (" + reason + "). Choose another place.");
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : shown_(std::move(other.shown_)),
      destination_(std::move(other.destination_)),
      temporary_(std::exchange(other.temporary_, fs::path{})),
      stream_(std::move(other.stream_)) {}

AtomicFile::~AtomicFile() {
    if (temporary_.empty() || temporary_ == destination_) return;
    stream_.close();
    std::error_code ignored;
    fs::remove(temporary_, ignored);
}

void AtomicFile::close() {
    if (!stream_.is_open()) return;
    stream_.close();
    if (!stream_) fail(shown_, "could not be written completely. Is the disk full?");
}

void AtomicFile::commit() {
    close();
    std::error_code error;
    if (temporary_ != destination_) fs::rename(temporary_, destination_, error);
    if (error) fail(shown_, "cannot be replaced (" + error.message() + "). Choose another place.");
    temporary_.clear();
}

}  // namespace elastolab
