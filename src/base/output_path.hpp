#pragma once

#include <filesystem>

namespace elastolab {

/// Whether a path leads to a stream that this process holds open, as /dev/stdout and /dev/fd/3 do. It may be a regular
/// file, which must be written to, not replaced while others write to it.
bool is_open_stream(std::filesystem::path path);

/// The file that a path stands for: where its symbolic links lead, whether or not there is anything. Throws Error when
/// they lead in a circle, and for a link that another user has put into a folder that everybody may write to (as the
/// kernel does where fs.protected_symlinks is set): it may lead to a file that was not meant.
std::filesystem::path followed_links(const std::filesystem::path& path);

}  // namespace elastolab
