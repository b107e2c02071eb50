#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace elastolab {

/// All bytes of a regular file; nothing when it is none (a pipe or a device is not even waited for) or cannot be read.
std::optional<std::string> read_regular_file(const std::filesystem::path& file);

}  // namespace elastolab
