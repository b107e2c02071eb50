#pragma once

#include <filesystem>

namespace elastolab::test {

/// What a window manager and a file manager say to a window of the display. Each returns when it was heard; throws
/// std::runtime_error when it is not.
void ask_to_close(unsigned long window);
void drop_file(unsigned long window, const std::filesystem::path& file);

}  // namespace elastolab::test
