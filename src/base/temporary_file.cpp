#include "base/temporary_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <string>
#include <string_view>
#include <system_error>

namespace elastolab {

namespace fs = std::filesystem;

namespace {

// Short, so that a long but legal destination does not become a name that is too long.
constexpr std::string_view kPrefix = ".elastolab-";
constexpr std::string_view kSuffix = ".tmp";
constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz012345";  // 32 of them: 5 bits each
constexpr std::size_t kRandomLetters = 20;

std::optional<std::string> random_name() {
    std::array<unsigned char, kRandomLetters> bytes{};
    if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) return std::nullopt;
    std::string name(kPrefix);
    for (const unsigned char byte : bytes) name += kLetters[byte % kLetters.size()];
    return name += kSuffix;
}

bool is_name_of_ours(const std::string& name) {
    return name.size() == kPrefix.size() + kRandomLetters + kSuffix.size() && name.starts_with(kPrefix) &&
           name.ends_with(kSuffix);
}

/// Whether nobody has it any more: it is our user's, a regular file, and no process holds its lock.
bool is_stale(int fd) {
    struct stat info {};
    return ::fstat(fd, &info) == 0 && S_ISREG(info.st_mode) && info.st_uid == ::geteuid() &&
           ::flock(fd, LOCK_EX | LOCK_NB) == 0;
}

/// Locks a new file. False when another process, looking for stale files, was faster and has removed it or is about to.
/// A file system without locks is no reason to fail: nobody can take the file for stale there.
bool is_kept(int fd) {
    if (::flock(fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return false;
    struct stat info {};
    return ::fstat(fd, &info) == 0 && info.st_nlink > 0;
}

}  // namespace

std::optional<TemporaryFile> TemporaryFile::make_in(const fs::path& folder, mode_t mode) {
    constexpr int kAttempts = 16;
    for (int i = 0; i < kAttempts; ++i) {
        const std::optional<std::string> name = random_name();
        if (!name) return std::nullopt;
        const fs::path path = folder / *name;
        FileDescriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode));
        if (!file && errno != EEXIST) return std::nullopt;
        if (file && is_kept(file.get())) return TemporaryFile{path, std::move(file)};
    }
    errno = EEXIST;
    return std::nullopt;
}

void TemporaryFile::remove_stale_in(const fs::path& folder) {
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        const fs::path path = entry->path();
        if (!is_name_of_ours(path.filename().string())) continue;
        const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
        if (file && is_stale(file.get())) ::unlink(path.c_str());
    }
}

void TemporaryFile::remove_own() {
    std::error_code error;
    for (fs::directory_iterator entry("/proc/self/fd", error), end; !error && entry != end; entry.increment(error)) {
        std::error_code ignored;
        const fs::path path = fs::read_symlink(entry->path(), ignored);
        if (is_name_of_ours(path.filename().string())) ::unlink(path.c_str());
    }
}

}  // namespace elastolab
