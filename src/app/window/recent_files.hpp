#pragma once

#include <filesystem>
#include <vector>

namespace elastolab {

/// The files opened last, newest first, kept in $XDG_STATE_HOME/elastolab/recent (or ~/.local/state). Reading and
/// writing never fails loudly: the list is a convenience.
std::vector<std::filesystem::path> load_recent_files();
void save_recent_files(const std::vector<std::filesystem::path>& files);

/// The list with `file` in front, each name once, at most ten.
std::vector<std::filesystem::path> with_recent_file(std::vector<std::filesystem::path> files,
                                                    const std::filesystem::path& file);

}  // namespace elastolab
