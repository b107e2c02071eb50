#include "study/report/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>
#include <system_error>

#include "base/error.hpp"

namespace elastolab {

FolderLock::FolderLock(const std::filesystem::path& folder)
    : folder_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (!folder_)
        throw Error(folder.string() + ": cannot be opened (" + std::generic_category().message(errno) +
                    "). Choose another folder with --out.");
    // File systems without locks answer with other errors; there, two runs are not noticed.
    if (::flock(folder_.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        throw Error(folder.string() +
                    ": another run writes there. Wait for its end or choose another folder with --out.");
}

}  // namespace elastolab
