#include "scene/user_text.hpp"

#include <new>

#include "base/error.hpp"
#include "base/text.hpp"

namespace elastolab {

std::string user_text(const std::exception& error) {
    if (dynamic_cast<const Error*>(&error) != nullptr) return one_line(error.what());
    if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr)
        return "The memory of this machine is used up. Use a coarser mesh, or the mode on-demand.";
    return "Internal error: " + one_line(error.what()) + ". Please report it.";
}

}  // namespace elastolab
