#pragma once

#include <filesystem>
#include <optional>

#include "base/file_descriptor.hpp"

namespace elastolab {

/// An empty file with an unpredictable name, newly created (never through a link) and locked (flock) as long as
/// `descriptor` is open. It outlives this object.
struct TemporaryFile {
    std::filesystem::path path;
    FileDescriptor descriptor;  ///< for writing

    /// mode: permissions, which the umask of the process narrows. None, with errno set, when it cannot be made.
    static std::optional<TemporaryFile> make_in(const std::filesystem::path& folder, mode_t mode);
    /// Removes this user's temporaries in a folder that no process has open any more: those of killed programs.
    static void remove_stale_in(const std::filesystem::path& folder);
    /// Removes all temporaries that this process has open, whoever works on them: for the end of the program.
    static void remove_own();
};

}  // namespace elastolab
