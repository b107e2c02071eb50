#include "base/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "base/error.hpp"
#include "base/output_path.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

bool is_written_directly(const fs::path& destination) {
    std::error_code error;
    return is_open_stream(destination) || (fs::exists(destination, error) && !fs::is_regular_file(destination, error));
}

[[noreturn]] void fail(const fs::path& shown, const std::string& finding) {
    throw Error(shown.string() + ": " + finding);
}

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

void require_folder(const fs::path& shown, const fs::path& file) {
    const fs::path folder = folder_of(file);
    std::error_code error;
    if (!fs::exists(folder, error)) fail(shown, "its folder does not exist. Create it or choose another place.");
    if (!fs::is_directory(folder, error)) fail(shown, "what should be its folder is a file. Choose another place.");
}

/// Gives a file the owner, the group and the permissions of the one that it is to replace, as far as this user may.
/// Where the group could not be kept, the new group gets no more rights than everybody.
void take_over_permissions(const fs::path& replaced, int fd) {
    struct stat old {};
    struct stat own {};
    if (::stat(replaced.c_str(), &old) != 0 || ::fstat(fd, &own) != 0) return;
    const bool is_same = old.st_uid == own.st_uid && old.st_gid == own.st_gid;
    const bool keeps_group =
        is_same || ::fchown(fd, old.st_uid, old.st_gid) == 0 || ::fchown(fd, static_cast<uid_t>(-1), old.st_gid) == 0;
    mode_t mode = old.st_mode & 0777U;
    if (!keeps_group) mode &= ~070U | (mode & 07U) << 3U;
    ::fchmod(fd, mode);  // fails on file systems that have no permissions
}

/// So that the new name outlives a power failure, too.
void sync_folder(const fs::path& folder) {
    const FileDescriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (opened) ::fsync(opened.get());
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& destination) : shown_(destination) {
    if (destination.filename().empty()) fail(shown_, "is not the name of a file. Name the file to write.");
    std::error_code error;
    if (fs::is_directory(destination, error)) fail(shown_, "is a folder. Name a file to write.");
    require_folder(shown_, destination);
    errno = 0;
    if (is_written_directly(destination))
        stream_.open(destination, std::ios::binary | std::ios::app);
    else
        open_beside(followed_links(destination));
    if (stream_) return;
    const std::string reason = std::generic_category().message(errno);
    discard();
    fail(shown_, "cannot be written there (" + reason + "). Choose another place.");
}

/// A temporary that is to replace a file is hidden from others until it gets that file's permissions.
void AtomicFile::open_beside(const fs::path& destination) {
    if (destination != shown_) require_folder(shown_, destination);
    destination_ = destination;
    const fs::path folder = folder_of(destination);
    TemporaryFile::remove_stale_in(folder);
    struct stat ignored {};
    const bool replaces = ::stat(destination.c_str(), &ignored) == 0;
    temporary_ = TemporaryFile::make_in(folder, replaces ? 0600 : 0666);
    if (temporary_)
        stream_.open("/proc/self/fd/" + std::to_string(temporary_->descriptor.get()), std::ios::binary);
    else
        stream_.setstate(std::ios::failbit);
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : shown_(std::move(other.shown_)),
      destination_(std::move(other.destination_)),
      temporary_(std::exchange(other.temporary_, std::nullopt)),
      stream_(std::move(other.stream_)) {}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::discard() {
    if (!temporary_) return;
    stream_.close();
    std::error_code ignored;
    fs::remove(temporary_->path, ignored);
    temporary_.reset();
}

void AtomicFile::close() {
    if (!stream_.is_open()) return;
    stream_.close();
    if (!stream_)
        fail(shown_, "could not be written completely. Is the disk full, or the size of files limited (ulimit -f)?");
    // Some file systems cannot do it (EINVAL) and say so; others find here that the disk is full.
    if (temporary_ && ::fsync(temporary_->descriptor.get()) != 0 && errno != EINVAL)
        fail(shown_, "could not be written completely (" + std::generic_category().message(errno) + ").");
}

void AtomicFile::commit() {
    close();
    if (!temporary_) return;
    take_over_permissions(destination_, temporary_->descriptor.get());
    std::error_code error;
    fs::rename(temporary_->path, destination_, error);
    if (error) fail(shown_, "cannot be replaced (" + error.message() + "). Choose another place.");
    temporary_.reset();
    sync_folder(folder_of(destination_));
}

}  // namespace elastolab
