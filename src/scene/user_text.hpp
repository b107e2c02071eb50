#pragma once

#include <exception>
#include <string>

namespace elastolab {

/// What to tell the user about an exception, in one line.
std::string user_text(const std::exception& error);

}  // namespace elastolab
