#include "base/output_path.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <system_error>

#include "base/error.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

constexpr int kMostLinks = 40;

/// One link further. `folder` is the canonical folder that `link` lies in.
fs::path next_of(const fs::path& link, const fs::path& folder) {
    std::error_code ignored;
    return folder / fs::read_symlink(link, ignored);
}

bool is_laid_by_a_stranger(const fs::path& link, const fs::path& folder) {
    struct stat of_link {};
    struct stat of_folder {};
    if (::lstat(link.c_str(), &of_link) != 0 || ::stat(folder.c_str(), &of_folder) != 0) return false;
    const bool shared = (of_folder.st_mode & S_ISVTX) != 0 && (of_folder.st_mode & S_IWOTH) != 0;
    return shared && of_link.st_uid != ::geteuid() && of_link.st_uid != of_folder.st_uid;
}

}  // namespace

bool is_open_stream(fs::path path) {
    std::error_code error;
    for (int i = 0; i < kMostLinks; ++i) {
        const fs::path folder = fs::canonical(fs::absolute(path).parent_path(), error);
        if (error) return false;
        if (folder.string().rfind("/proc/", 0) == 0 && folder.filename() == "fd") return true;
        if (!fs::is_symlink(path, error)) return false;
        path = next_of(path, folder);
    }
    return false;
}

fs::path followed_links(const fs::path& start) {
    std::error_code error;
    fs::path path = start;
    for (int i = 0; i < kMostLinks; ++i) {
        if (!fs::is_symlink(path, error)) return path;
        const fs::path folder = fs::canonical(fs::absolute(path).parent_path(), error);
        if (error) return path;
        if (is_laid_by_a_stranger(path, folder))
            throw Error(start.string() +
                        ": is a symbolic link of another user in a folder that everybody may write in. " +
                        "Name the file itself.");
        path = next_of(path, folder);
    }
    throw Error(start.string() + ": is a symbolic link that leads back to itself. Name the file itself.");
}

}  // namespace elastolab
