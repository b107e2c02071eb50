#pragma once

#include <filesystem>

namespace elastolab {

/// Where the viewer keeps what it remembers of a person's sessions: $XDG_STATE_HOME/elastolab, or
/// ~/.local/state/elastolab. Empty when there is no home folder.
std::filesystem::path state_folder();

}  // namespace elastolab
