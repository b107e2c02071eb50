#include "app/window/state_folder.hpp"

#include <cstdlib>

namespace elastolab {

std::filesystem::path state_folder() {
    if (const char* state = std::getenv("XDG_STATE_HOME"); state != nullptr && *state != '\0')
        return std::filesystem::path(state) / "elastolab";
    if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
        return std::filesystem::path(home) / ".local" / "state" / "elastolab";
    return {};
}

}  // namespace elastolab
