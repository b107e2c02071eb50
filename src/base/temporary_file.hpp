#pragma once

#include <filesystem>
#include <optional>

#include "base/file_descriptor.hpp"

namespace elastolab {

/// An empty file of a name that nobody can foretell, made new and never through a link, and locked (flock) as long as
/// `descriptor` is open. It stays when this object goes.
struct TemporaryFile {
    std::filesystem::path path;
    FileDescriptor descriptor;  ///< for writing

    /// mode: permissions, which the umask of the process narrows. None, with errno set, when it cannot be made.
    static std::optional<TemporaryFile> make_in(const std::filesystem::path& folder, mode_t mode);
    /// Removes this user's temporaries in a folder that no process works on: left by one that was killed.
    static void remove_stale_in(const std::filesystem::path& folder);
    /// Removes all temporaries that this process has open, whoever works on them: for the end of the program.
    static void remove_own();
};

}  // namespace elastolab
