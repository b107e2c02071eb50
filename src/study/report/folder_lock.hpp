#pragma once

#include <filesystem>

#include "base/file_descriptor.hpp"

namespace elastolab {

/// While one lives, no other process (and no other part of this one) can have one on the same folder. It leaves
/// nothing in the folder, and ends with the process however that ends.
class FolderLock {
public:
    /// Throws Error when another has it, or when there is no such folder.
    explicit FolderLock(const std::filesystem::path& folder);

private:
    FileDescriptor folder_;
};

}  // namespace elastolab
