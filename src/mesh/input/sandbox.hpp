#pragma once

#include <filesystem>
#include <vector>

namespace elastolab {

/// Gives up, for the rest of this process, what a reader of files does not need: from now on it may read files in these
/// folders and below (Landlock, where the kernel has it), open nothing for writing, and start no process, reach no
/// network and signal no other process (seccomp, likewise). Where the kernel has neither, or a sanitizer needs more,
/// nothing changes. Refused calls fail with EACCES or EPERM.
void enter_sandbox(const std::vector<std::filesystem::path>& readable_folders);

}  // namespace elastolab
