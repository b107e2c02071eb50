#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace elastolab {

/// The files opened last, newest first, kept in state_folder(). Reading and writing never fails loudly: the list is a
/// convenience.
std::vector<std::filesystem::path> load_recent_files();
void save_recent_files(const std::vector<std::filesystem::path>& files);

/// The folder last used in a file dialog; empty when there is none, or none any more.
/// kind: of what is opened or saved there, such as "open" or ".png"; each kind remembers its own, and begins in the
/// one last used for anything.
std::filesystem::path load_last_folder(const std::string& kind);
void save_last_folder(const std::string& kind, const std::filesystem::path& folder);

/// The list with `file` in front, each name once, at most ten.
std::vector<std::filesystem::path> with_recent_file(std::vector<std::filesystem::path> files,
                                                    const std::filesystem::path& file);

}  // namespace elastolab
